// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How likely an edge supports a hypothesis by chance.
#pragma once

#include <curvix/edges.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace curvix {

// Counts of edges by place (square cells) and orientation (bins of 30 degrees).
class EdgeDensity {
 public:
  EdgeDensity() = default;
  EdgeDensity(const std::vector<Edge2d>& edges, int width, int height);

  // Chance that a random place near `pixel`, expecting an edge in direction
  // `angle_rad`, finds one within `gate_px` across it and 15 degrees: the share
  // of the surroundings (about 48 x 48 pixels) that lies within the gate of
  // contours of like orientation. In [0.005, 0.95].
  double ChanceOfSupport(const Eigen::Vector2d& pixel,
                         double angle_rad,
                         double gate_px) const;

 private:
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint16_t> counts_;  // [row][column][bin], saturating
};

}  // namespace curvix
