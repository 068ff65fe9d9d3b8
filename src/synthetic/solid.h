// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Solids made of boxes, frustums and spheres.
#pragma once

#include <curvix/scene.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace curvix {

enum class PrimitiveShape {
  kBox,      // |x| <= size.x, |y| <= size.y, |z| <= size.z
  kFrustum,  // 0 <= z <= size.z, radius from size.x (z = 0) to size.y (top)
  kSphere,   // radius size.x
};

// A convex body in its own frame, added to or taken out of the solid.
struct Primitive {
  PrimitiveShape shape = PrimitiveShape::kBox;
  bool is_added = true;
  double albedo = 1;      // factor on the grey values of its faces
  Eigen::Vector3d size;   // world units, see PrimitiveShape
  Rigid3 world_from_own;  // its pose
};

struct Ray {
  Eigen::Vector3d origin;     // world
  Eigen::Vector3d direction;  // world, any length > 0
};

// Where a ray enters the solid: origin + t * direction.
struct Hit {
  double t = 0;
  int primitive_idx = 0;
  int face_idx = 0;        // of the primitive, see NumFaces
  Eigen::Vector3d normal;  // unit, out of the solid
};

// Faces of a shape. Box: -x, +x, -y, +y, -z, +z. Frustum: side, bottom, top.
// Sphere: one.
int NumFaces(PrimitiveShape shape);

// Negative inside, zero on the face, positive outside; world units near the
// face (exact for planes and spheres and cylinders).
double FaceValue(const Primitive& primitive,
                 int face_idx,
                 const Eigen::Vector3d& world);

// Primitives applied one after the other: each adds its body or takes it away.
class Solid {
 public:
  explicit Solid(std::vector<Primitive> primitives);

  const std::vector<Primitive>& primitives() const { return primitives_; }

  // Largest distance of an added body from the origin.
  double radius() const { return radius_; }

  bool Contains(const Eigen::Vector3d& world) const;

  // The first entry at t > 0 of a ray that starts outside. Ties: the primitive
  // listed first.
  std::optional<Hit> Trace(const Ray& ray) const;

 private:
  struct Placed {  // primitive frame as matrices: cheaper than quaternions
    Eigen::Matrix3d own_from_world_rotation;
    Eigen::Vector3d origin;
  };
  struct Span {  // the part of a ray inside one primitive
    int primitive_idx;
    double enter, exit;
    int enter_face, exit_face;
  };
  std::optional<Span> Intersect(int primitive_idx, const Ray& ray) const;
  bool IsInsideAfter(const std::vector<Span>& spans, double t) const;
  Eigen::Vector3d Normal(const Hit& hit, const Eigen::Vector3d& world) const;

  std::vector<Primitive> primitives_;
  std::vector<Placed> placed_;
  double radius_ = 0;
};

// The same solid with its bounding box (of the added bodies) centred on the
// origin and the box's longest side equal to `longest_side`.
std::vector<Primitive> Normalized(std::vector<Primitive> primitives,
                                  double longest_side);

}  // namespace curvix
