// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Coordinates on the faces of primitives, and what
// is painted there, with exact outlines.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "synthetic/primitive.h"
#include "synthetic/true_curve.h"

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

// Patches of even tone in the coordinates of a face, see FaceFromOwn.
class FacePattern {
 public:
  struct Value {
    double tone = 1;             // factor on the grey value of the face
    std::uint64_t patch_id = 0;  // changes where the tone jumps
  };

  virtual ~FacePattern() = default;
  virtual Value At(const Eigen::Vector2d& uv) const = 0;

  // Where the tone jumps, in the plane z = 0 of (u, v): lines and arcs that the
  // face may cut off. Tones to both sides differ by an eighth at least.
  virtual std::vector<TrueCurve> Outlines() const = 0;
};

// Bricks in mortar, wooden boards' grain or print that fit `area`; `unit` is
// the size of the scene: a brick is about 0.15 x 0.065 units. Null for kNone,
// for faces too narrow to hold a pattern, and for grain on a round side.
std::unique_ptr<FacePattern> MakeFacePattern(SurfacePattern pattern,
                                             const FaceArea& area,
                                             double unit,
                                             std::uint64_t seed);

}  // namespace curvix
