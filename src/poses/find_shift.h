// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Where a view's picture belongs, if its pose is off
// by several pixels.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace curvix {

// What one projected sample of a curve sees around it.
struct EdgesAround {
  // Across its projected tangent; unit.
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  // Signed distances of edges of like direction, along the normal. Pixels.
  std::vector<double> distances_px;
};

// The shift of the picture, up to `reach_px` in x and in y, that brings most
// samples onto an edge. Each sample says how well its nearest edge fits, so
// edges that are not the sample's outvote nobody: they do not agree with each
// other on a shift. Zero unless another shift is clearly better. Pixels; ties:
// smaller y, then smaller x.
Eigen::Vector2d FindShift(const std::vector<EdgesAround>& samples,
                          double reach_px);

}  // namespace curvix
