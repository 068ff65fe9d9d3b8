// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "synthetic/primitive.h"

namespace curvix {

// OwnFaceValue of a point in the world.
inline double FaceValue(const SolidPrimitive& primitive,
                        int face_idx,
                        const Eigen::Vector3d& world) {
  const Rigid3& pose = primitive.world_from_own;
  return OwnFaceValue(primitive,
                      face_idx,
                      pose.rotation.conjugate() * (world - pose.translation));
}

}  // namespace curvix
