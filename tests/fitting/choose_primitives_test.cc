// SPDX-License-Identifier: BSD-3-Clause
// Curves that are nearly something else.
#include <cmath>

#include "base/angles.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/fitting/sampled_curves.h"

namespace curvix {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;

// Too oval for a circle, if only by a few standard deviations.
TEST(ChoosePrimitives, SlightlyOvalCurvesAreEllipses) {
  for (const double off : {3.0, 4.0, 5.0, 7.0}) {
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
    EXPECT_THAT(Kinds(fitted.curves[0]), ElementsAre("ellipse")) << off;
    EXPECT_TRUE(fitted.nodes.empty());
  }
}

}  // namespace
}  // namespace curvix
