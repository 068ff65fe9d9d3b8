// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/curve_tip.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "base/angles.h"
#include "tests/support/edges_along_baseline.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

constexpr double kSigmaAcrossPx = 0.15;
constexpr double kPixelAtTheEdge = 0.01;

TEST(CurveTip, OfAnEdgeAlongTheBaselineRunsAcrossTheRays) {
  Random random(1);
  const SpaceEdge edge{{0, 0, 0}, {0, 1, 0}};
  for (int trial = 0; trial < 100; ++trial) {
    const CurveTip tip(edge,
                       MeasureAlongTheBaseline(edge, 2, random),
                       kSigmaAcrossPx,
                       kPixelAtTheEdge);
    EXPECT_GT(tip.edge().tangent.y(), std::cos(DegToRad(10)));
  }
}

TEST(CurveTip, OfAnEdgeThatImagesTellRunsIntoTheDepth) {
  Random random(2);
  const SpaceEdge edge{{0, 0, 0}, Eigen::Vector3d(1, 0, 1).normalized()};
  const CurveTip tip(edge,
                     MeasureAlongTheBaseline(edge, 0, random),
                     kSigmaAcrossPx,
                     kPixelAtTheEdge);
  EXPECT_GT(tip.edge().tangent.dot(edge.tangent), std::cos(DegToRad(15)));
}

}  // namespace
}  // namespace curvix
