// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The shift of an image whose pose is off by several
// pixels.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace curvix {

// The edges around one projected sample of a curve.
struct EdgesAround {
  // Across its projected tangent; unit.
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  // Signed distances of edges of like direction, along the normal. Pixels.
  std::vector<double> distances_px;
};

// The shift of the image, up to `reach_px` in x and in y, that brings most
// samples onto an edge. Wrong matches do no harm, since they share no shift.
// Zero unless another shift is clearly better. Pixels; ties: of whole steps,
// smaller y, then smaller x.
Eigen::Vector2d FindShift(const std::vector<EdgesAround>& samples,
                          double reach_px);

}  // namespace curvix
