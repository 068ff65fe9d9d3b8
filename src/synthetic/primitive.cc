// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/primitive.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "geometry/directions.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

// Keeps [enter, exit] of `interval`, both ends on `face` where it cuts.
void Clip(double enter, double exit, int face, RayInterval& interval) {
  if (enter > interval.enter) {
    interval.enter = enter;
    interval.enter_face = face;
  }
  if (exit < interval.exit) {
    interval.exit = exit;
    interval.exit_face = face;
  }
}

// Keeps low <= o + t * d <= high; the faces are `low_face` and the next.
void ClipSlab(double o,
              double d,
              double low,
              double high,
              int low_face,
              RayInterval& interval) {
  if (d == 0) {
    if (o < low || o > high) Clip(kInfinity, -kInfinity, low_face, interval);
    return;
  }
  const double to_low = (low - o) / d;
  const double to_high = (high - o) / d;
  Clip(d > 0 ? to_low : to_high, kInfinity, low_face + (d < 0), interval);
  Clip(-kInfinity, d > 0 ? to_high : to_low, low_face + (d > 0), interval);
}

// Keeps a t^2 + 2 b t + c <= 0 where that is one interval of `interval`.
void ClipQuadric(
    double a, double b, double c, int face, RayInterval& interval) {
  const double discriminant = b * b - a * c;
  if (discriminant <= 0) {
    if (a > 0 || c > 0) Clip(kInfinity, -kInfinity, face, interval);
    return;
  }
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  double t0 = c / q;
  double t1 = a == 0 ? std::copysign(kInfinity, -b) : q / a;
  if (t0 > t1) std::swap(t0, t1);
  if (a > 0) {
    Clip(t0, t1, face, interval);
  } else if (a == 0) {
    b > 0 ? Clip(-kInfinity, c / q, face, interval)
          : Clip(c / q, kInfinity, face, interval);
  } else {  // outside the roots: one nappe of a cone each
    RayInterval before = interval;
    Clip(-kInfinity, t0, face, before);
    Clip(t1, kInfinity, face, interval);
    if (before.exit - before.enter > interval.exit - interval.enter) {
      interval = before;
    }
  }
}

// Largest value of direction . x over the primitive.
double Support(const SolidPrimitive& primitive, const Vector3d& direction) {
  const Vector3d d = primitive.world_from_own.rotation.conjugate() * direction;
  const Vector3d& size = primitive.size;
  const double base = primitive.world_from_own.translation.dot(direction);
  switch (primitive.shape) {
    case PrimitiveShape::kBox:
    case PrimitiveShape::kSheet:
      return base + d.cwiseAbs().dot(size);
    case PrimitiveShape::kFrustum: {
      const double width = d.head<2>().norm();
      return base +
             std::max(width * size.x(), width * size.y() + d.z() * size.z());
    }
    case PrimitiveShape::kSphere:
      return base + size.x() * direction.norm();
  }
  return base;
}

}  // namespace

int NumFaces(PrimitiveShape shape) {
  if (shape == PrimitiveShape::kBox) return 6;
  if (shape == PrimitiveShape::kSheet) return 2;
  return shape == PrimitiveShape::kFrustum ? 3 : 1;
}

double OwnFaceValue(const SolidPrimitive& primitive,
                    int face,
                    const Vector3d& x) {
  const Vector3d& size = primitive.size;
  switch (primitive.shape) {
    case PrimitiveShape::kBox:
      return (face % 2 == 0 ? -x[face / 2] : x[face / 2]) - size[face / 2];
    case PrimitiveShape::kFrustum: {
      if (face == 1) return -x.z();
      if (face == 2) return x.z() - size.z();
      const double slope = (size.y() - size.x()) / size.z();
      return x.head<2>().norm() - (size.x() + slope * x.z());
    }
    case PrimitiveShape::kSphere:
      return x.norm() - size.x();
    case PrimitiveShape::kSheet:
      return face == 0 ? x.z() : -x.z();
  }
  return 0;
}

Vector3d OwnNormal(const SolidPrimitive& primitive,
                   int face,
                   const Vector3d& x) {
  switch (primitive.shape) {
    case PrimitiveShape::kBox:
      return (face % 2 == 0 ? -1.0 : 1.0) * Vector3d::Unit(face / 2);
    case PrimitiveShape::kFrustum: {
      if (face == 1) return -Vector3d::UnitZ();
      if (face == 2) return Vector3d::UnitZ();
      const double slope =
          (primitive.size.y() - primitive.size.x()) / primitive.size.z();
      Vector3d normal(x.x(), x.y(), 0);
      normal.normalize();
      normal.z() = -slope;
      return normal.normalized();
    }
    case PrimitiveShape::kSphere:
      return x.normalized();
    case PrimitiveShape::kSheet:
      return face == 0 ? Vector3d::UnitZ() : Vector3d(-Vector3d::UnitZ());
  }
  return Vector3d::UnitZ();
}

RayInterval Intersect(const SolidPrimitive& primitive, const Ray& own_ray) {
  const Vector3d& o = own_ray.origin;
  const Vector3d& d = own_ray.direction;
  const Vector3d& size = primitive.size;
  RayInterval interval;
  switch (primitive.shape) {
    case PrimitiveShape::kBox:
      for (int axis = 0; axis < 3; ++axis) {
        ClipSlab(o[axis], d[axis], -size[axis], size[axis], 2 * axis, interval);
      }
      break;
    case PrimitiveShape::kFrustum: {
      const double slope = (size.y() - size.x()) / size.z();
      const double radius = size.x() + slope * o.z();
      const double widening = slope * d.z();
      ClipSlab(o.z(), d.z(), 0, size.z(), 1, interval);
      if (interval.IsEmpty()) break;
      ClipQuadric(d.head<2>().squaredNorm() - widening * widening,
                  o.head<2>().dot(d.head<2>()) - radius * widening,
                  o.head<2>().squaredNorm() - radius * radius,
                  0,
                  interval);
      break;
    }
    case PrimitiveShape::kSphere:
      ClipQuadric(d.squaredNorm(),
                  o.dot(d),
                  o.squaredNorm() - size.x() * size.x(),
                  0,
                  interval);
      break;
    case PrimitiveShape::kSheet:
      interval.exit = interval.enter;
      break;
  }
  return interval;
}

std::optional<double> SheetHit(const SolidPrimitive& sheet,
                               const Ray& own_ray) {
  const Vector3d& o = own_ray.origin;
  const Vector3d& d = own_ray.direction;
  const double t = -o.z() / d.z();
  if (!(t > 0) || !std::isfinite(t)) return std::nullopt;
  const Eigen::Array2d at = (o + t * d).head<2>().array().abs();
  if ((at > sheet.size.head<2>().array()).any()) return std::nullopt;
  return t;
}

double FarthestDistance(const SolidPrimitive& primitive) {
  const Vector3d& size = primitive.size;
  const Rigid3& pose = primitive.world_from_own;
  double farthest = 0;
  switch (primitive.shape) {
    case PrimitiveShape::kBox:
    case PrimitiveShape::kSheet:
      for (int corner = 0; corner < 8; ++corner) {
        const Vector3d sign(
            corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        farthest = std::max(farthest, (pose * size.cwiseProduct(sign)).norm());
      }
      break;
    case PrimitiveShape::kFrustum:
      for (const auto& [z, radius] :
           {std::pair(0.0, size.x()), std::pair(size.z(), size.y())}) {
        const Vector3d centre = pose * Vector3d(0, 0, z);
        const double axial = (pose.rotation.conjugate() * centre).z();
        const double across =
            std::sqrt(std::max(0.0, centre.squaredNorm() - axial * axial));
        farthest = std::max(farthest, std::hypot(axial, across + radius));
      }
      break;
    case PrimitiveShape::kSphere:
      farthest = pose.translation.norm() + size.x();
      break;
  }
  return farthest;
}

Eigen::AlignedBox3d BoundingBox(const std::vector<SolidPrimitive>& primitives) {
  Eigen::AlignedBox3d box;
  for (const SolidPrimitive& primitive : primitives) {
    if (!primitive.is_added) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d unit = Vector3d::Unit(axis);
      box.min()[axis] = std::min(box.min()[axis], -Support(primitive, -unit));
      box.max()[axis] = std::max(box.max()[axis], Support(primitive, unit));
    }
  }
  return box;
}

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
  sheet.world_from_own = {Eigen::Quaterniond(axes).normalized(),
                          corner + (side + other_side) / 2};
  return sheet;
}

SolidPrimitive Without(SolidPrimitive primitive, double albedo) {
  primitive.is_added = false;
  primitive.albedo = albedo;
  return primitive;
}

SolidPrimitive Hole(const Vector3d& from, const Vector3d& to, double radius) {
  const Vector3d beyond = kCutMargin * (to - from).normalized();
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
