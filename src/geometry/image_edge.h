// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 and 5. Detected edges as geometry, and how far apart oriented
// points are.
#pragma once

#include <curvix/edges.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "geometry/edge_geometry.h"

namespace curvix {

// The tangent of an Edge2d with this angle.
inline Eigen::Vector2d TangentAt(float angle) {
  const double radians = static_cast<double>(angle);
  return {std::cos(radians), std::sin(radians)};
}

// Unit, across the edge.
inline Eigen::Vector2d ToBrightSide(const Edge2d& edge) {
  const Eigen::Vector2d tangent = TangentAt(edge.angle);
  return {-tangent.y(), tangent.x()};
}

inline ImageEdge ToImageEdge(const Edge2d& edge) {
  return {edge.position, TangentAt(edge.angle)};
}

// `edge_maps` by view.
inline const Edge2d& EdgeOf(const EdgeRef& ref,
                            const std::vector<EdgeMap>& edge_maps) {
  return edge_maps[static_cast<std::size_t>(ref.view_idx)]
      .edges[static_cast<std::size_t>(ref.edge_idx)];
}

// Sec. 5, Fig. 6(b)-(d): how far apart two oriented points are. With d from one
// position to the other, measured against the line of either edge; the larger
// of both values counts, so the order does not matter.
struct EdgeDistances {
  double normal = 0;      // d_n: |d - (d.t)t|, world
  double tangential = 0;  // d_t: |d.t|, world
  double angle = 0;       // between the two lines, radians, in [0, pi/2]
};

// `Oriented` has a position and a unit tangent (Edge3d, CurveSample).
template <typename Oriented>
EdgeDistances MeasureDistances(const Oriented& a, const Oriented& b) {
  const Eigen::Vector3d offset = b.position - a.position;
  const double along_a = offset.dot(a.tangent);
  const double along_b = offset.dot(b.tangent);
  const double normal_a = (offset - along_a * a.tangent).norm();
  const double normal_b = (offset - along_b * b.tangent).norm();
  return {std::max(normal_a, normal_b),
          std::max(std::abs(along_a), std::abs(along_b)),
          std::atan2(a.tangent.cross(b.tangent).norm(),
                     std::abs(a.tangent.dot(b.tangent)))};
}

}  // namespace curvix
