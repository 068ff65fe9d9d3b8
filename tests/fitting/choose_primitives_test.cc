// SPDX-License-Identifier: BSD-3-Clause
// Curves that are nearly something else.
#include <cmath>
#include <utility>

#include "base/angles.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/fitting/sampled_curves.h"

namespace curvix {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;

// By so many standard deviations.
TEST(ChoosePrimitives, SlightlyOvalCurvesAreOneCircleOrEllipse) {
  for (const auto& [off, kind] : {std::pair(1.5, "circle"),
                                  std::pair(3.0, "circle"),
                                  std::pair(5.0, "circle"),
                                  std::pair(7.0, "ellipse")}) {
    const double half = off * kSigma / 2;
    const FittedCurves fitted = Fit({Sample(
        [&](double t) {
          const double angle = 2 * kPi * t;
          return Vector3d((0.5 + half) * std::cos(angle),
                          (0.5 - half) * std::sin(angle),
                          0);
        },
        200,
        true)});
    EXPECT_THAT(Kinds(fitted.curves[0]), ElementsAre(kind)) << off;
    EXPECT_TRUE(fitted.nodes.empty());
  }
}

// Along a line to `turn` and back.
TEST(ChoosePrimitives, HairpinsAreTwoLines) {
  for (const double turn : {0.5, 0.7, 0.8}) {
    const FittedCurves fitted = Fit({Sample(
        [&](double t) { return Vector3d(turn - std::abs(turn - t), 0, 0); },
        80,
        false,
        0)});
    ASSERT_THAT(Kinds(fitted.curves[0]), ElementsAre("line", "line")) << turn;
    const std::vector<CurveFit>& fits = fitted.curves[0].fits;
    EXPECT_NEAR(fits[0].start.x(), 0, 0.03);
    EXPECT_NEAR(fits[0].end.x(), turn, 0.03);
    EXPECT_EQ(fits[1].start, fits[0].end);
    EXPECT_NEAR(fits[1].end.x(), 2 * turn - 1, 0.03);
  }
}

// There and back along three quarters of a circle.
TEST(ChoosePrimitives, HairpinsAlongACircleAreTwoArcs) {
  const FittedCurves fitted = Fit({Sample(
      [&](double t) {
        const double angle = 1.5 * kPi * (1 - std::abs(1 - 2 * t));
        return Vector3d(std::cos(angle), std::sin(angle), 0);
      },
      160)});
  ASSERT_THAT(Kinds(fitted.curves[0]), ElementsAre("arc", "arc"));
  for (const CurveFit& fit : fitted.curves[0].fits) {
    EXPECT_NEAR(Length(fit), 1.5 * kPi, 0.2);
  }
}

}  // namespace
}  // namespace curvix
