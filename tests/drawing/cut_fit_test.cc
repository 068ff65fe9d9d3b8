// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/cut_fit.h"

#include <cmath>
#include <vector>

#include "base/angles.h"
#include "gtest/gtest.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

CurveFit Line(const Vector3d& start, const Vector3d& end) {
  CurveFit fit;
  fit.start = start;
  fit.end = end;
  fit.start_node = 1;
  fit.end_node = 2;
  return fit;
}

CurveFit Circle(double start, double end) {
  CurveFit fit;
  fit.kind = FitKind::kArc;
  fit.closed = end - start > 6.28;
  fit.center = {1, 2, 3};
  fit.major = {2, 0, 0};
  fit.minor = {0, 0, 2};
  fit.start_angle = start;
  fit.end_angle = end;
  fit.start = PointAt(fit, 0);
  fit.end = PointAt(fit, 1);
  return fit;
}

CurveFit Spline() {
  Random random(3);
  CurveFit fit;
  fit.kind = FitKind::kSpline;
  for (int i = 0; i < 9; ++i) {
    fit.control_points.push_back(random.NormalVector());
  }
  fit.knots = {0, 0, 0, 0, 0.1, 0.3, 0.35, 0.6, 0.8, 1, 1, 1, 1};
  fit.start = fit.control_points.front();
  fit.end = fit.control_points.back();
  return fit;
}

TEST(CutFit, APartIsTheSameCurve) {
  for (const CurveFit& fit : {Line({0, 0, 0}, {1, 2, 3}),
                              Circle(-1, 4),
                              Circle(0.5, 0.5 + 2 * kPi),
                              Spline()}) {
    for (const auto& [t0, t1] :
         {std::pair(0.0, 0.3), {0.1, 0.1001}, {0.3, 0.8}, {0.32, 1.0}}) {
      const CurveFit part = PartOf(fit, t0, t1);
      EXPECT_EQ(part.kind, fit.kind);
      EXPECT_FALSE(part.closed);
      for (int i = 0; i <= 10; ++i) {
        const double t = i / 10.0;
        const Vector3d expected = PointAt(fit, t0 + t * (t1 - t0));
        EXPECT_LT((PointAt(part, t) - expected).norm(), 1e-12);
      }
      EXPECT_LT((part.start - PointAt(fit, t0)).norm(), 1e-12);
      EXPECT_LT((part.end - PointAt(fit, t1)).norm(), 1e-12);
    }
  }
}

TEST(CutFit, NodesAreKeptWhereNothingIsCut) {
  const CurveFit part = PartOf(Line({0, 0, 0}, {1, 0, 0}), 0, 0.5);
  EXPECT_EQ(part.start_node, 1);
  EXPECT_EQ(part.end_node, -1);
}

TEST(CutFit, SlicesOfALine) {
  const CurveFit line = Line({0, 0, -1}, {8, 0, 3});
  const auto parts = PartsWithin(line, Vector3d::UnitZ(), 0, 1);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_LT((parts[0].start - Vector3d(2, 0, 0)).norm(), 1e-12);
  EXPECT_LT((parts[0].end - Vector3d(4, 0, 1)).norm(), 1e-12);
  EXPECT_TRUE(PartsWithin(line, Vector3d::UnitZ(), 4, 5).empty());
  EXPECT_TRUE(PartsWithin(line, Vector3d::UnitY(), 1, 2).empty());
  const auto all = PartsWithin(line, Vector3d::UnitY(), -1, 2);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].start_node, 1);
}

TEST(CutFit, SlicesOfAWholeCircleAreArcs) {
  // Wherever it begins; z goes from 1 to 5, and is above 4 for a third.
  for (const double start : {-3.0, 0.0, kPi / 2, 2.5}) {
    const CurveFit circle = Circle(start, start + 2 * kPi);
    const auto top = PartsWithin(circle, Vector3d::UnitZ(), 4, 9);
    ASSERT_EQ(top.size(), 1u) << start;
    EXPECT_NEAR(Length(top[0]), 2 * 2 * kPi / 3, 1e-12);
    const auto sides = PartsWithin(circle, Vector3d::UnitZ(), 2, 4);
    ASSERT_EQ(sides.size(), 2u) << start;
    EXPECT_NEAR(Length(sides[0]), 2 * kPi / 3, 1e-12);
    EXPECT_NEAR(Length(sides[1]), 2 * kPi / 3, 1e-12);
    EXPECT_TRUE(PartsWithin(circle, Vector3d::UnitZ(), 0, 6)[0].closed);
  }
}

TEST(CutFit, SlicesOfASplineHaveAllOfItThatIsInside) {
  const CurveFit spline = Spline();
  double inside = 0;
  constexpr int kSteps = 200000;
  for (int i = 0; i < kSteps; ++i) {
    const Vector3d a = PointAt(spline, static_cast<double>(i) / kSteps);
    const Vector3d b = PointAt(spline, (i + 1.0) / kSteps);
    if (a.x() > -0.2 && a.x() < 0.5) inside += (b - a).norm();
  }
  double found = 0;
  for (const CurveFit& part :
       PartsWithin(spline, Vector3d::UnitX(), -0.2, 0.5)) {
    found += Length(part);
    for (int i = 0; i <= 20; ++i) {
      const double x = PointAt(part, i / 20.0).x();
      EXPECT_TRUE(x > -0.2 - 1e-9 && x < 0.5 + 1e-9) << x;
    }
  }
  EXPECT_NEAR(found, inside, 1e-4 * inside);
}

}  // namespace
}  // namespace curvix
