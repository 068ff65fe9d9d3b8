// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/curve_tip.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "geometry/adjust_edge.h"
#include "tests/support/random.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

constexpr double kSigmaAcrossPx = 0.15;
constexpr double kPixelAtTheEdge = 0.01;

// 2D edges of `edge`, turned by up to `max_turn_deg`, in images by a camera
// that moves along the y axis at 6 units from it.
std::vector<PlaneMeasurement> MeasureAlongTheBaseline(const SpaceEdge& edge,
                                                      double max_turn_deg,
                                                      Random& random) {
  std::vector<PlaneMeasurement> measurements;
  for (int i = -3; i <= 3; ++i) {
    const PosedView view = LookAt({6, 0.8 * i, 0.1 * (i % 2)}, {0, 0, 0});
    ImageEdge image = *ProjectEdge(view, edge);
    const double turn = DegToRad(random.Uniform(-max_turn_deg, max_turn_deg));
    image.tangent = Eigen::Rotation2Dd(turn) * image.tangent;
    measurements.push_back(MeasurePlane(view, image));
  }
  return measurements;
}

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
