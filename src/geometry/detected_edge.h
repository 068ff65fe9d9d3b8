// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3. Detected edges as geometry.
#pragma once

#include <curvix/edges.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/angles.h"
#include "geometry/edge_geometry.h"

namespace curvix {

// The tangent of an Edge2d with this angle, as exact as the angle is.
inline Eigen::Vector2d TangentAt(float angle) {
  return Eigen::Vector2f(std::cos(angle), std::sin(angle)).cast<double>();
}

inline ImageEdge ToImageEdge(const Edge2d& edge) {
  return {edge.position, TangentAt(edge.angle)};
}

// Unit, across the edge.
inline Eigen::Vector2d ToBrightSide(const Edge2d& edge) {
  return ToImageEdge(edge).Normal();
}

// Of the bright side over Edge2d::level, if the image is a blurred step; grey
// levels, at most that between black and white. The sharpness must be positive.
inline double HalfContrast(const Edge2d& edge) {
  return std::min(127.5,
                  static_cast<double>(edge.strength) *
                      std::sqrt(kPi / 2 / static_cast<double>(edge.sharpness)));
}

// `edge_maps` by view.
inline const Edge2d& EdgeOf(const EdgeRef& ref,
                            const std::vector<EdgeMap>& edge_maps) {
  return edge_maps[static_cast<std::size_t>(ref.view_idx)]
      .edges[static_cast<std::size_t>(ref.edge_idx)];
}

}  // namespace curvix
