// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "synthetic/solid.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/check.h"
#include "synthetic/street.h"

namespace curvix {

using Eigen::Vector3d;

Solid::Solid(std::vector<SolidPrimitive> primitives)
    : primitives_(std::move(primitives)) {
  for (const SolidPrimitive& primitive : primitives_) {
    CURVIX_CHECK(primitive.size.allFinite(), "size of a primitive");
    const double reach = (1 + 1e-9) * OwnRadius(primitive);
    placed_.push_back(
        {primitive.world_from_own.rotation.conjugate().toRotationMatrix(),
         primitive.world_from_own.translation,
         reach * reach});
    if (primitive.is_added) {
      radius_ = std::max(radius_, FarthestDistance(primitive));
    }
  }
  box_ = BoundingBox(primitives_);
  Vector3d sides = box_.sizes();
  std::sort(sides.begin(), sides.end());
  detail_ = std::min(radius_, sides[1]);
}

bool Solid::Contains(const Vector3d& world) const {
  bool is_inside = false;
  for (std::size_t i = 0; i < primitives_.size(); ++i) {
    const SolidPrimitive& primitive = primitives_[i];
    if (primitive.is_added == is_inside) continue;  // would change nothing
    const Vector3d offset = world - placed_[i].origin;
    if (offset.squaredNorm() > placed_[i].squared_reach) continue;
    const Vector3d own = placed_[i].own_from_world_rotation * offset;
    bool in_primitive = true;
    for (int face = 0; face < NumFaces(primitive.shape) && in_primitive;
         ++face) {
      in_primitive = OwnFaceValue(primitive, face, own) <= 0;
    }
    if (in_primitive) is_inside = primitive.is_added;
  }
  return is_inside;
}

std::vector<Solid::Span> Solid::Spans(const Ray& ray) const {
  std::vector<Span> spans;
  spans.reserve(primitives_.size());
  const double squared_length = ray.direction.squaredNorm();
  for (std::size_t i = 0; i < primitives_.size(); ++i) {
    const Vector3d offset = ray.origin - placed_[i].origin;
    if (offset.cross(ray.direction).squaredNorm() >
        placed_[i].squared_reach * squared_length) {
      continue;
    }
    const Eigen::Matrix3d& rotation = placed_[i].own_from_world_rotation;
    const Ray own{rotation * offset, rotation * ray.direction};
    const RayInterval inside = Intersect(primitives_[i], own);
    if (inside.IsEmpty() || inside.exit <= 0) continue;
    spans.push_back({inside, static_cast<int>(i)});
  }
  return spans;
}

bool Solid::IsInsideAfter(const std::vector<Span>& spans, double t) const {
  bool is_inside = false;
  for (const Span& span : spans) {
    if (span.enter <= t && t < span.exit) {
      is_inside =
          primitives_[static_cast<std::size_t>(span.primitive_idx)].is_added;
    }
  }
  return is_inside;
}

Vector3d Solid::Normal(const Hit& hit, const Vector3d& world) const {
  const auto i = static_cast<std::size_t>(hit.primitive_idx);
  const Eigen::Matrix3d& rotation = placed_[i].own_from_world_rotation;
  const Vector3d own = rotation * (world - placed_[i].origin);
  const Vector3d normal =
      rotation.transpose() * OwnNormal(primitives_[i], hit.face_idx, own);
  return primitives_[i].is_added ? normal : Vector3d(-normal);
}

std::optional<Hit> Solid::Trace(const Ray& ray) const {
  const std::vector<Span> spans = Spans(ray);
  // The solid can begin only where a body is entered or a hole is left.
  Hit hit;
  hit.t = std::numeric_limits<double>::infinity();
  for (const Span& span : spans) {
    const bool is_added =
        primitives_[static_cast<std::size_t>(span.primitive_idx)].is_added;
    const double t = is_added ? span.enter : span.exit;
    if (t <= 0 || t >= hit.t || !IsInsideAfter(spans, t)) continue;
    hit.t = t;
    hit.primitive_idx = span.primitive_idx;
    hit.face_idx = is_added ? span.enter_face : span.exit_face;
  }
  if (hit.t == std::numeric_limits<double>::infinity()) return std::nullopt;
  hit.normal = Normal(hit, ray.origin + hit.t * ray.direction);
  return hit;
}

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// What is taken away reaches beyond what it is taken from, so that no two faces
// coincide by rounding.
constexpr double kBeyond = 0.05;
constexpr double kHoleAlbedo = 0.8;  // as if less light came in

SolidPrimitive Box(const Vector3d& low, const Vector3d& high) {
  SolidPrimitive box;
  box.shape = PrimitiveShape::kBox;
  box.size = (high - low) / 2;
  box.world_from_own.translation = (low + high) / 2;
  return box;
}

// From the centre of the base along `axis`.
SolidPrimitive Frustum(const Vector3d& base,
                       const Vector3d& axis,
                       double base_radius,
                       double top_radius) {
  SolidPrimitive frustum;
  frustum.shape = PrimitiveShape::kFrustum;
  frustum.size = {base_radius, top_radius, axis.norm()};
  frustum.world_from_own = {
      Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis), base};
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

SolidPrimitive Without(SolidPrimitive primitive, double albedo = 1) {
  primitive.is_added = false;
  primitive.albedo = albedo;
  return primitive;
}

// A hole through a wall between `from` and `to`.
SolidPrimitive Hole(const Vector3d& from, const Vector3d& to, double radius) {
  const Vector3d beyond = kBeyond * (to - from).normalized();
  return Without(Cylinder(from - beyond, to - from + 2 * beyond, radius),
                 kHoleAlbedo);
}

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

std::vector<SolidPrimitive> Primitives(SyntheticSolid solid, int num_views) {
  switch (solid) {
    case SyntheticSolid::kBlock:
      return Block();
    case SyntheticSolid::kCylinder:
      return UprightCylinder();
    case SyntheticSolid::kCone:
      return Cone();
    case SyntheticSolid::kSphere:
      return CutSphere();
    case SyntheticSolid::kFacade:
      return Facade(num_views);
    case SyntheticSolid::kPart:
      break;
  }
  return Part();
}

}  // namespace

Solid MakeSolid(SyntheticSolid solid, double scale, int num_views) {
  const std::vector<SolidPrimitive> primitives = Primitives(solid, num_views);
  const Vector3d sides = BoundingBox(primitives).sizes();
  const double scaled =
      solid == SyntheticSolid::kFacade ? sides.z() : sides.maxCoeff();
  return Solid(Normalized(primitives, scale * sides.maxCoeff() / scaled));
}

}  // namespace curvix
