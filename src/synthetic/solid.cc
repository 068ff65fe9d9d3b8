// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/solid.h"

#include <algorithm>
#include <utility>

#include "base/check.h"
#include "base/infinity.h"

namespace curvix {

using Eigen::Vector3d;

Solid::Solid(std::vector<SolidPrimitive> primitives)
    : primitives_(std::move(primitives)) {
  for (const SolidPrimitive& primitive : primitives_) {
    CURVIX_CHECK(primitive.size.allFinite(), "size of a primitive");
    const double reach = (1 + 1e-9) * primitive.size.norm();
    placed_.push_back(
        {primitive.world_from_own.rotation.conjugate().toRotationMatrix(),
         primitive.world_from_own.translation,
         reach * reach});
    if (primitive.shape == PrimitiveShape::kSheet) {
      sheet_idxs_.push_back(placed_.size() - 1);
    }
    if (primitive.is_added) {
      radius_ = std::max(radius_, FarthestDistance(primitive));
    }
  }
  box_ = BoundingBox(primitives_);
  Vector3d sides = box_.sizes();
  std::ranges::sort(sides);
  detail_ = std::min(radius_, sides[1]);
}

bool Solid::Contains(const Vector3d& world) const {
  bool is_inside = false;
  for (std::size_t i = 0; i < primitives_.size(); ++i) {
    const SolidPrimitive& primitive = primitives_[i];
    if (primitive.is_added == is_inside) continue;  // would change nothing
    if (primitive.shape == PrimitiveShape::kSheet) continue;
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
    const RayInterval inside = Intersect(primitives_[i], InFrameOf(i, ray));
    if (inside.IsEmpty() || inside.exit <= 0) continue;
    spans.push_back({inside, i});
  }
  return spans;
}

Ray Solid::InFrameOf(std::size_t primitive_idx, const Ray& ray) const {
  const Placed& placed = placed_[primitive_idx];
  const Eigen::Matrix3d& rotation = placed.own_from_world_rotation;
  return {rotation * (ray.origin - placed.origin), rotation * ray.direction};
}

bool Solid::IsInsideAfter(const std::vector<Span>& spans, double t) const {
  bool is_inside = false;
  for (const Span& span : spans) {
    if (span.enter <= t && t < span.exit) {
      is_inside = primitives_[span.primitive_idx].is_added;
    }
  }
  return is_inside;
}

Vector3d Solid::Normal(const Hit& hit, const Vector3d& world) const {
  const SolidPrimitive& primitive = primitives_[hit.primitive_idx];
  const Placed& placed = placed_[hit.primitive_idx];
  const Eigen::Matrix3d& rotation = placed.own_from_world_rotation;
  const Vector3d own = rotation * (world - placed.origin);
  const Vector3d normal =
      rotation.transpose() * OwnNormal(primitive, hit.face_idx, own);
  return primitive.is_added ? normal : Vector3d(-normal);
}

void Solid::TraceSheets(const Ray& ray,
                        const std::vector<Span>& spans,
                        Hit& hit) const {
  for (const std::size_t i : sheet_idxs_) {
    const Ray own = InFrameOf(i, ray);
    const std::optional<double> t = SheetHit(primitives_[i], own);
    if (!t || *t >= hit.t || IsInsideAfter(spans, *t)) continue;
    hit.t = *t;
    hit.primitive_idx = i;
    hit.face_idx = own.direction.z() < 0 ? 0 : 1;
  }
}

std::optional<Hit> Solid::Trace(const Ray& ray) const {
  const std::vector<Span> spans = Spans(ray);
  // The solid can begin only where a body is entered or a hole is left.
  Hit hit;
  hit.t = kInfinity;
  for (const Span& span : spans) {
    const bool is_added = primitives_[span.primitive_idx].is_added;
    const double t = is_added ? span.enter : span.exit;
    if (t <= 0 || t >= hit.t || !IsInsideAfter(spans, t)) continue;
    hit.t = t;
    hit.primitive_idx = span.primitive_idx;
    hit.face_idx = is_added ? span.enter_face : span.exit_face;
  }
  TraceSheets(ray, spans, hit);
  if (hit.t == kInfinity) return std::nullopt;
  hit.normal = Normal(hit, ray.origin + hit.t * ray.direction);
  return hit;
}

}  // namespace curvix
