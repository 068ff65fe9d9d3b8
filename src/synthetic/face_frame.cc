// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Coordinates on the faces of primitives.
#include "synthetic/face_pattern.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"

namespace curvix {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

bool IsRoundSide(const SolidPrimitive& primitive, int face) {
  return primitive.shape == PrimitiveShape::kFrustum && face == 0;
}

double LargerRadius(const SolidPrimitive& frustum) {
  return std::max(frustum.size.x(), frustum.size.y());
}

// The axes of u and v of a flat face.
struct Axes {
  int u = 0;
  int v = 1;
};

Axes AxesOf(const SolidPrimitive& primitive, int face) {
  const bool is_box = primitive.shape == PrimitiveShape::kBox;
  const int across = is_box ? face / 2 : 2;
  return {across == 0 ? 1 : 0, across == 2 ? 1 : 2};
}

// An arc around a frustum at the height of `flat`, which goes along u.
TrueCurve Around(const SolidPrimitive& frustum, const TrueCurve& flat) {
  const double v = flat.origin.y();
  const Vector3d& size = frustum.size;
  const double per_radian = LargerRadius(frustum);
  const double begin = flat.origin.x() / per_radian;
  const double turn = flat.along.x();  // +1 or -1
  TrueCurve arc = flat;
  arc.radius = size.x() + (size.y() - size.x()) * v / size.z();
  arc.origin = {0, 0, v};
  arc.along = {std::cos(begin), std::sin(begin), 0};
  arc.across = turn * Vector3d(-std::sin(begin), std::cos(begin), 0);
  arc.length = flat.length / per_radian * arc.radius;
  return arc;
}

TrueCurve InWorld(const Rigid3& world_from_own, TrueCurve curve) {
  curve.origin = world_from_own * curve.origin;
  curve.along = world_from_own.rotation * curve.along;
  curve.across = world_from_own.rotation * curve.across;
  return curve;
}

}  // namespace

std::optional<FaceArea> AreaOfFace(const SolidPrimitive& primitive, int face) {
  const Vector3d& size = primitive.size;
  if (IsRoundSide(primitive, face)) {
    const double half = kPi * LargerRadius(primitive);
    return FaceArea{{-half, 0}, {half, size.z()}, true};
  }
  switch (primitive.shape) {
    case PrimitiveShape::kBox:
    case PrimitiveShape::kSheet: {
      const auto [u, v] = AxesOf(primitive, face);
      return FaceArea{{-size[u], -size[v]}, {size[u], size[v]}};
    }
    case PrimitiveShape::kFrustum: {
      const Vector2d half = Vector2d::Constant(face == 1 ? size.x() : size.y());
      return FaceArea{-half, half};
    }
    case PrimitiveShape::kSphere:
      break;
  }
  return std::nullopt;
}

Vector2d FaceFromOwn(const SolidPrimitive& primitive,
                     int face,
                     const Vector3d& own) {
  if (IsRoundSide(primitive, face)) {
    return {LargerRadius(primitive) * std::atan2(own.y(), own.x()), own.z()};
  }
  const auto [u, v] = AxesOf(primitive, face);
  return {own[u], own[v]};
}

Vector3d OwnFromFace(const SolidPrimitive& primitive,
                     int face,
                     const Vector2d& uv) {
  const Vector3d& size = primitive.size;
  if (IsRoundSide(primitive, face)) {
    const double angle = uv.x() / LargerRadius(primitive);
    const double radius = size.x() + (size.y() - size.x()) * uv.y() / size.z();
    return {radius * std::cos(angle), radius * std::sin(angle), uv.y()};
  }
  Vector3d own = Vector3d::Zero();
  if (primitive.shape == PrimitiveShape::kBox) {
    own[face / 2] = face % 2 == 0 ? -size[face / 2] : size[face / 2];
  } else if (primitive.shape == PrimitiveShape::kFrustum && face == 2) {
    own.z() = size.z();
  }
  const auto [u, v] = AxesOf(primitive, face);
  own[u] = uv.x();
  own[v] = uv.y();
  return own;
}

TrueCurve OnFace(const SolidPrimitive& primitive,
                 int face,
                 const TrueCurve& flat) {
  if (IsRoundSide(primitive, face) && flat.along.x() != 0) {
    return InWorld(primitive.world_from_own, Around(primitive, flat));
  }
  const auto own = [&](const Vector3d& uv) {
    return OwnFromFace(primitive, face, uv.head<2>());
  };
  if (IsRoundSide(primitive, face)) {
    return InWorld(
        primitive.world_from_own,
        Segment(own(flat.origin), own(flat.Position(flat.length)), flat.kind));
  }
  const Vector3d zero = own(Vector3d::Zero());
  TrueCurve curve = flat;
  curve.origin = own(flat.origin);
  curve.along = own(flat.along) - zero;
  curve.across = own(flat.across) - zero;
  return InWorld(primitive.world_from_own, curve);
}

}  // namespace curvix
