// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The exact sharp edges of a solid.
#pragma once

#include "synthetic/solid.h"

#include <Eigen/Core>
#include <vector>

namespace curvix {

// A straight or circular edge, by arc length s in [0, length]:
// straight: origin + s * along; circular, of radius r and a = s / r:
// origin + r * (cos(a) * along + sin(a) * across).
struct CreaseCurve {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();  // unit
  Eigen::Vector3d across = Eigen::Vector3d::Zero();  // unit; circular only
  double radius = 0;                                 // 0: straight
  double length = 0;                                 // world units
  bool is_closed = false;                            // a whole circle

  Eigen::Vector3d Position(double s) const;
  Eigen::Vector3d Tangent(double s) const;  // unit
};

// Every edge at which two faces of the solid meet at an angle of more than
// about 25 degrees, each once, whole: an edge that others touch stays one
// curve. Faces that continue each other smoothly make no edge. Candidates are
// plane with plane, plane with frustum at right angles to its axis, and plane
// with sphere; other pairs are not looked at. Edges shorter than a hundredth of
// the solid's radius are left out.
std::vector<CreaseCurve> CreaseCurves(const Solid& solid);

}  // namespace curvix
