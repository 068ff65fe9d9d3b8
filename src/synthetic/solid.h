// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Solids made of boxes, frustums and spheres.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "synthetic/primitive.h"

namespace curvix {

// Where a ray enters the solid: origin + t * direction.
struct Hit {
  double t = 0;
  std::size_t primitive_idx = 0;
  int face_idx = 0;        // of the primitive, see NumFaces
  Eigen::Vector3d normal;  // unit, out of the solid
};

// Primitives applied one after the other: each adds its body or takes it away.
class Solid {
 public:
  explicit Solid(std::vector<SolidPrimitive> primitives);

  const std::vector<SolidPrimitive>& primitives() const { return primitives_; }

  // Largest distance of an added body from the origin.
  double radius() const { return radius_; }

  // Of the added bodies.
  const Eigen::AlignedBox3d& box() const { return box_; }

  // The size of what there is to see: the radius, or the second longest side of
  // the box if that is smaller, as of a long row.
  double detail() const { return detail_; }

  bool Contains(const Eigen::Vector3d& world) const;

  // The first entry, or the first sheet, at t > 0 of a ray that starts outside.
  // Ties: the primitive listed first; bodies before sheets.
  std::optional<Hit> Trace(const Ray& ray) const;

 private:
  struct Placed {  // primitive frame as matrices: cheaper than quaternions
    Eigen::Matrix3d own_from_world_rotation;
    Eigen::Vector3d origin;
    double squared_reach;  // nothing of it is further from the origin
  };
  struct Span : RayInterval {  // the part of a ray inside one primitive
    std::size_t primitive_idx = 0;
  };
  std::vector<Span> Spans(const Ray& ray) const;
  Ray InFrameOf(std::size_t primitive_idx, const Ray& ray) const;
  void TraceSheets(const Ray& ray,
                   const std::vector<Span>& spans,
                   Hit& hit) const;
  bool IsInsideAfter(const std::vector<Span>& spans, double t) const;
  Eigen::Vector3d Normal(const Hit& hit, const Eigen::Vector3d& world) const;

  std::vector<SolidPrimitive> primitives_;
  std::vector<Placed> placed_;
  std::vector<std::size_t> sheet_idxs_;
  Eigen::AlignedBox3d box_;
  double radius_ = 0;
  double detail_ = 0;
};

}  // namespace curvix
