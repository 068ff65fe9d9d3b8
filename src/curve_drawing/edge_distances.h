// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5, Fig. 6(b)-(d). How far apart two oriented points are.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace curvix {

// With d from one position to the other, measured against the line of either
// edge; the larger of both values counts, so the order does not matter.
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
