// SPDX-License-Identifier: BSD-3-Clause
// 2D edges in images by a camera that moves along a line.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "base/angles.h"
#include "geometry/adjust_edge.h"
#include "tests/support/random.h"
#include "tests/support/test_views.h"

namespace curvix {

// 2D edges of `edge`, turned by up to `max_turn_deg`, in seven images by a
// camera that moves along the y axis and looks at the origin, 6 units away.
inline std::vector<PlaneMeasurement> MeasureAlongTheBaseline(
    const SpaceEdge& edge, double max_turn_deg, Random& random) {
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

}  // namespace curvix
