// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "synthetic/parts.h"

#include "synthetic/bodies.h"

#include <Eigen/Geometry>

namespace curvix {

using Eigen::Quaterniond;
using Eigen::Vector3d;

std::vector<SolidPrimitive> Block() {
  return {Box({0, 0, 0}, {1, 0.7, 0.55}),
          Without(Box({0.55, -kBeyond, 0.25}, {1 + kBeyond, 0.8, 0.8}))};
}

std::vector<SolidPrimitive> UprightCylinder() {
  return {Box({-0.5, -0.5, 0}, {0.5, 0.5, 0.14}),
          Cylinder({0, 0, 0.07}, {0, 0, 0.63}, 0.28)};
}

std::vector<SolidPrimitive> Cone() {
  return {Box({-0.5, -0.4, 0}, {0.5, 0.4, 0.14}),
          Frustum({0, 0, 0.14}, {0, 0, 0.55}, 0.33, 0.14)};
}

std::vector<SolidPrimitive> CutSphere() {
  const Vector3d up = Vector3d(-0.35, -0.3, 0.9).normalized();
  SolidPrimitive cut = Box({-1, -1, 0}, {1, 1, 1});
  cut.world_from_own.rotation =
      Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up);
  cut.world_from_own.translation = (0.22 + 0.5) * up;
  return {Sphere({0, 0, 0}, 0.5), Without(cut)};
}

// A bracket: base and wall, a hole through the wall, and on the base a boss
// with a bore, a cone and a round dimple.
std::vector<SolidPrimitive> Part() {
  const double top = 0.14;  // of the base
  return {Box({0, 0, 0}, {1, 0.7, top}),
          Box({0, 0, 0}, {0.14, 0.7, 0.6}),
          Cylinder({0.4, 0.24, top / 2}, {0, 0, 0.22}, 0.15),
          Frustum({0.76, 0.48, top}, {0, 0, 0.24}, 0.14, 0.07),
          Hole({0, 0.35, 0.38}, {0.14, 0.35, 0.38}, 0.13),
          Hole({0.4, 0.24, 0}, {0.4, 0.24, 0.29}, 0.08),
          Without(Sphere({0.78, 0.18, top + 0.06}, 0.12), kHoleAlbedo)};
}

}  // namespace curvix
