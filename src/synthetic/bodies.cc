// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/bodies.h"

#include <Eigen/Geometry>

#include "base/angles.h"
#include "geometry/directions.h"

namespace curvix {

using Eigen::Quaterniond;
using Eigen::Vector3d;

SolidPrimitive Box(const Vector3d& low, const Vector3d& high) {
  SolidPrimitive box;
  box.shape = PrimitiveShape::kBox;
  box.size = (high - low) / 2;
  box.world_from_own.translation = (low + high) / 2;
  return box;
}

SolidPrimitive Frustum(const Vector3d& base,
                       const Vector3d& axis,
                       double base_radius,
                       double top_radius) {
  SolidPrimitive frustum;
  frustum.shape = PrimitiveShape::kFrustum;
  frustum.size = {base_radius, top_radius, axis.norm()};
  frustum.world_from_own = {ShortestRotation(Vector3d::UnitZ(), axis), base};
  return frustum;
}

SolidPrimitive Cylinder(const Vector3d& base,
                        const Vector3d& axis,
                        double radius) {
  return Frustum(base, axis, radius, radius);
}

SolidPrimitive Sphere(const Vector3d& centre, double radius) {
  SolidPrimitive sphere;
  sphere.shape = PrimitiveShape::kSphere;
  sphere.size = Vector3d::Constant(radius);
  sphere.world_from_own.translation = centre;
  return sphere;
}

SolidPrimitive FlatSheet(const Vector3d& corner,
                         const Vector3d& side,
                         const Vector3d& other_side) {
  SolidPrimitive sheet;
  sheet.shape = PrimitiveShape::kSheet;
  sheet.size = {side.norm() / 2, other_side.norm() / 2, 0};
  Eigen::Matrix3d axes;
  axes << side.normalized(), other_side.normalized(),
      side.cross(other_side).normalized();
  sheet.world_from_own = {Quaterniond(axes).normalized(),
                          corner + (side + other_side) / 2};
  return sheet;
}

SolidPrimitive Without(SolidPrimitive primitive, double albedo) {
  primitive.is_added = false;
  primitive.albedo = albedo;
  return primitive;
}

SolidPrimitive Hole(const Vector3d& from, const Vector3d& to, double radius) {
  const Vector3d beyond = kBeyond * (to - from).normalized();
  return Without(Cylinder(from - beyond, to - from + 2 * beyond, radius),
                 kHoleAlbedo);
}

SolidPrimitive Turned(double degrees, SolidPrimitive primitive) {
  primitive.world_from_own.rotation =
      Eigen::AngleAxisd(DegToRad(degrees), Vector3d::UnitZ()) *
      primitive.world_from_own.rotation;
  return primitive;
}

SolidPrimitive Painted(SurfacePattern pattern, SolidPrimitive primitive) {
  primitive.pattern = pattern;
  return primitive;
}

}  // namespace curvix
