// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How many edges lie about by chance.
#pragma once

#include <curvix/edges.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace curvix {

// Counts of edges by place (square cells) and orientation (bins of 15 degrees).
class EdgeDensity {
 public:
  EdgeDensity() = default;
  EdgeDensity(const EdgeMap& map, int width, int height);

  // Edges of like direction (within 15 degrees of `angle_rad`) per pixel across
  // them, around `pixel`: the length of their contours in the surroundings
  // (about 48 x 48 pixels) over the area. At least 0.003, one contour in 330
  // pixels.
  double Density(const Eigen::Vector2d& pixel, double angle_rad) const;

 private:
  int columns_ = 0;
  int rows_ = 0;
  double spacing_px_ = 0.5;            // of edges along a contour
  std::vector<std::uint16_t> counts_;  // [row][column][bin], saturating
};

}  // namespace curvix
