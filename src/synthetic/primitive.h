// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The convex bodies that solids are made of, and
// functions that make them from their measures.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "base/infinity.h"

namespace curvix {

enum class PrimitiveShape {
  kBox,      // |x| <= size.x, |y| <= size.y, |z| <= size.z
  kFrustum,  // 0 <= z <= size.z, radius from size.x (z = 0) to size.y (top)
  kSphere,   // radius size.x
  kSheet,    // |x| <= size.x, |y| <= size.y, z = 0: two sides, no inside
};

// What is painted on the flat faces of a body, and round the sides of frustums.
enum class SurfacePattern {
  kNone,
  kBrick,  // bricks in mortar
  kWood,   // grain; flat faces only
  kPrint,  // a label with letters
  kMixed,  // as a scene to be made: all of them, each where it belongs
};

// A convex body in its own frame, added to or taken out of the solid. A sheet
// is added; it is where it is whatever bodies are there.
struct SolidPrimitive {
  PrimitiveShape shape = PrimitiveShape::kBox;
  bool is_added = true;
  double albedo = 1;  // factor on the grey values of its faces
  SurfacePattern pattern = SurfacePattern::kNone;
  Eigen::Vector3d size;   // world units, see PrimitiveShape
  Rigid3 world_from_own;  // its pose
};

// A point of the world in the frame of the primitive.
inline Eigen::Vector3d OwnFromWorld(const SolidPrimitive& primitive,
                                    const Eigen::Vector3d& x) {
  const Rigid3& pose = primitive.world_from_own;
  return pose.rotation.conjugate() * (x - pose.translation);
}

struct Ray {
  Eigen::Vector3d origin;     // world
  Eigen::Vector3d direction;  // world, any length > 0
};

// Faces of a shape. Box: -x, +x, -y, +y, -z, +z. Frustum: side, bottom, top.
// Sphere: one. Sheet: the side that +z comes out of, and the other.
int NumFaces(PrimitiveShape shape);

// The unit normal of the face out of the primitive, near a point of the face.
// Primitive frame.
Eigen::Vector3d OwnNormal(const SolidPrimitive& primitive,
                          int face_idx,
                          const Eigen::Vector3d& own);

// Negative inside, zero on the face, positive outside, for a point in the
// primitive's frame; world units near the face (exact for planes, spheres and
// cylinders).
double OwnFaceValue(const SolidPrimitive& primitive,
                    int face_idx,
                    const Eigen::Vector3d& own);

// The part of a ray's line inside a body, and the faces at both ends.
struct RayInterval {
  double enter = -kInfinity;
  double exit = kInfinity;
  int enter_face = 0;
  int exit_face = 0;
  bool IsEmpty() const { return !(enter < exit); }
};

// For a ray in the primitive's frame; empty where it misses. A sheet has no
// inside: SheetHit.
RayInterval Intersect(const SolidPrimitive& primitive, const Ray& own_ray);

// Where a ray in the frame of a sheet crosses it, t > 0.
std::optional<double> SheetHit(const SolidPrimitive& sheet, const Ray& own_ray);

// The largest distance of the primitive from the world's origin.
double FarthestDistance(const SolidPrimitive& primitive);

// Of the added bodies; empty without any.
Eigen::AlignedBox3d BoundingBox(const std::vector<SolidPrimitive>& primitives);

// What is taken away reaches this far beyond what it is taken from, so that no
// two faces coincide by rounding.
inline constexpr double kCutMargin = 0.05;
inline constexpr double kHoleAlbedo = 0.8;  // as if less light came in

SolidPrimitive Box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

// From the centre of the base along `axis`.
SolidPrimitive Frustum(const Eigen::Vector3d& base,
                       const Eigen::Vector3d& axis,
                       double base_radius,
                       double top_radius);
SolidPrimitive Cylinder(const Eigen::Vector3d& base,
                        const Eigen::Vector3d& axis,
                        double radius);

SolidPrimitive Sphere(const Eigen::Vector3d& centre, double radius);

// The parallelogram of two sides at right angles that begin at `corner`.
SolidPrimitive FlatSheet(const Eigen::Vector3d& corner,
                         const Eigen::Vector3d& side,
                         const Eigen::Vector3d& other_side);

SolidPrimitive Without(SolidPrimitive primitive, double albedo = 1);

// A hole through a wall between `from` and `to`.
SolidPrimitive Hole(const Eigen::Vector3d& from,
                    const Eigen::Vector3d& to,
                    double radius);

// Turned around the vertical axis through its centre.
SolidPrimitive Turned(double degrees, SolidPrimitive primitive);

SolidPrimitive Painted(SurfacePattern pattern, SolidPrimitive primitive);

}  // namespace curvix
