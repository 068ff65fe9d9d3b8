// SPDX-License-Identifier: BSD-3-Clause
// Splines in any unit, and polygons of other programs.
#include <curvix/fitting.h>

#include <cmath>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "fitting/primitive.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/fitting/sampled_curves.h"

namespace curvix {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;

Curve Scaled(Curve curve, double scale) {
  for (CurveSample& s : curve.samples) {
    s.position *= scale;
    s.sigma *= scale;
  }
  return curve;
}

TEST(FitCurves, SplinesDoNotDependOnTheUnit) {
  const Curve helix = Sample(
      [](double t) {
        return Vector3d(std::cos(9 * t) - 1, std::sin(9 * t), 2 * t);
      },
      400);
  const Curve line = Sample([](double t) { return Vector3d(t, 0, 0); }, 100);
  for (const double scale : {1.0, 1e-5, 1e-3, 1e6}) {
    const FittedCurves fitted =
        Fit({Scaled(helix, scale), Scaled(line, scale)});
    ASSERT_THAT(Kinds(fitted.curves[0]), ElementsAre("spline")) << scale;
    const CurveFit& spline = fitted.curves[0].fits[0];
    ASSERT_GE(spline.start_node, 0);
    EXPECT_EQ(
        PointAt(spline, 0),
        fitted.nodes[static_cast<std::size_t>(spline.start_node)].position);
  }
}

TEST(FitSpline, EndsWhereItIsToldInAnyUnit) {
  const Vector3d end(2, 0, 1);
  for (const double scale : {1e-6, 1e-3, 1.0, 1e6}) {
    FitSamples samples;
    for (int i = 0; i <= 100; ++i) {
      const double a = 2 * kPi * i / 100;
      FitSample& sample = samples.emplace_back();
      sample.position =
          scale * Vector3d(2 * std::cos(a), std::sin(a), std::cos(3 * a));
      sample.sigma = 1e-3 * scale;
    }
    const auto spline = FitSpline(
        samples, 12, std::pair<Vector3d, Vector3d>(scale * end, scale * end));
    ASSERT_TRUE(spline) << scale;
    EXPECT_EQ(spline->At(0), scale * end);
    EXPECT_EQ(spline->At(1), scale * end);
  }
}

// As drawn by other programs.
TEST(FitCurves, SamplesAtCornersOnlyAreLinesBetween) {
  const auto polygon = [](const std::vector<Vector3d>& corners, bool closed) {
    Curve curve;
    curve.closed = closed;
    for (const Vector3d& corner : corners) {
      curve.samples.emplace_back().position = corner;
    }
    return curve;
  };
  const std::vector<Vector3d> corners = {
      {0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  const FittedCurves fitted =
      Fit({polygon(corners, true),
           polygon(corners, false),
           polygon({corners[0], corners[1], corners[2]}, false)});
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<CurveFit>& fits = fitted.curves[c].fits;
    ASSERT_EQ(fits.size(), 4 - c);
    for (std::size_t i = 0; i < fits.size(); ++i) {
      EXPECT_EQ(KindName(fits[i]), "line");
      EXPECT_LT((fits[i].start - corners[i]).norm(), 1e-6);
      EXPECT_LT((fits[i].end - corners[(i + 1) % 4]).norm(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace curvix
