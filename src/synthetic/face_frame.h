// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Coordinates on the faces of primitives.
#pragma once

#include "synthetic/primitive.h"
#include "synthetic/true_curve.h"

#include <Eigen/Core>
#include <optional>

namespace curvix {

// A rectangle that holds all of a face.
struct FaceArea {
  Eigen::Vector2d low;    // world units
  Eigen::Vector2d high;   // likewise
  bool is_round = false;  // the side of a frustum: u goes round it
};

// The coordinates (u, v) of a face: Cartesian on flat ones, with v up on
// upright faces of a box; on the side of a frustum u is the angle from the x
// axis times the larger radius, within +-pi radii, and v is z. A sphere has
// none.
std::optional<FaceArea> AreaOfFace(const SolidPrimitive& primitive,
                                   int face_idx);

// (u, v) of a point of such a face, in the primitive's frame, and back.
Eigen::Vector2d FaceFromOwn(const SolidPrimitive& primitive,
                            int face_idx,
                            const Eigen::Vector3d& own);
Eigen::Vector3d OwnFromFace(const SolidPrimitive& primitive,
                            int face_idx,
                            const Eigen::Vector2d& uv);

// A curve in the plane (z = 0) of (u, v), in the world. On the side of a
// frustum segments along u or v only.
TrueCurve OnFace(const SolidPrimitive& primitive,
                 int face_idx,
                 const TrueCurve& flat);

}  // namespace curvix
