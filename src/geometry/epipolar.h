// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(a). Epipolar geometry as a pencil of planes.
//
// All epipolar planes of two views contain the baseline. A plane's half on one
// side of it has an angle around the baseline, and a point in space has the
// same angle in both views: X - C1 and X - C2 differ by a multiple of the
// baseline. So the epipolar constraint compares two numbers, an epipolar wedge
// is an interval of angles, and epipoles inside the image or at infinity are no
// special cases.
#pragma once

#include <curvix/edges.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/angles.h"
#include "model/posed_view.h"

namespace curvix {

// An angle around the baseline and how far it moves per pixel.
struct EpipolarAngle {
  double angle = 0;       // radians, (-pi, pi]
  double rad_per_px = 0;  // gradient magnitude with respect to the pixel
};

class EpipolarPencil {
 public:
  // nullopt when the two centres coincide: no baseline, no depth.
  static std::optional<EpipolarPencil> Make(const PosedView& view1,
                                            const PosedView& view2);

  // Unit, from view1 to view2, world.
  const Eigen::Vector3d& baseline() const { return baseline_; }

 private:
  friend class EpipolarAngles;
  Eigen::Vector3d baseline_, u_, v_;  // right-handed, orthonormal
};

// The epipolar angles of the pixels of one view.
class EpipolarAngles {
 public:
  // `view`: one of the two views of the pencil.
  EpipolarAngles(const EpipolarPencil& pencil, const PosedView& view);

  // Of the epipolar plane through `pixel`. nullopt within half a degree of the
  // baseline, where a ray has no depth.
  std::optional<EpipolarAngle> AngleOf(const Eigen::Vector2d& pixel) const;

 private:
  // Their products with a homogeneous pixel are the components of its ray.
  Eigen::Vector3d along_u_, along_v_, along_baseline_;
};

// F with x2^T F x1 = 0 for pixels x1, x2 of the two views.
Eigen::Matrix3d FundamentalMatrix(const PosedView& view1,
                                  const PosedView& view2);

// The epipolar line of `pixel` of view 1 in view 2: n . x + c = 0 with unit n.
struct Line2 {
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  // unit
  double offset = 0;                                  // pixels

  double SignedDistance(const Eigen::Vector2d& x) const {
    return normal.dot(x) + offset;
  }
  Eigen::Vector2d Direction() const { return {-normal.y(), normal.x()}; }
};
Line2 EpipolarLine(const Eigen::Matrix3d& fundamental,
                   const Eigen::Vector2d& pixel);

struct Interval {
  double begin = 0;
  double end = 0;

  bool Contains(double x) const { return begin <= x && x <= end; }
};

// How view 2 sees the rays of view 1.
class RayProjection {
 public:
  RayProjection(const PosedView& view1, const PosedView& view2);

  // Where view 2 sees what lies on the ray of `pixel` of view 1 between the
  // depths `nearest` (>= 0) and `farthest` (up to infinity): pixels along the
  // direction of `line`, its epipolar line. All of the line if an end is not in
  // front of view 2.
  Interval SeenAlong(const Line2& line,
                     const Eigen::Vector2d& pixel,
                     double nearest,
                     double farthest) const;

 private:
  Eigen::Matrix3d at_infinity_;  // pixels of view 1 to those of view 2
  Eigen::Vector3d epipole_;      // of view 1's centre in view 2
};

// The wedge of an edge: all epipolar angles of the disc of radius Delta gamma
// around it. Angles wrap at pi: an interval may reach beyond it.
struct Wedge {
  double center = 0;      // radians, (-pi, pi]
  double half_width = 0;  // radians
};

// The wedge of the disc around `pixel`. nullopt near the baseline, as
// EpipolarAngles::AngleOf().
std::optional<Wedge> WedgeOf(const EpipolarAngles& angles,
                             const Eigen::Vector2d& pixel,
                             double tolerance_px);

// Whether two wedges of one pencil have an epipolar plane in common.
bool Meet(const Wedge& a, const Wedge& b);

// The edges of one view in buckets by their epipolar angle. Edges near the
// baseline, which have no depth, are left out. Building takes O(edges).
class SortedByAngle {
 public:
  SortedByAngle(const EpipolarAngles& angles,
                const std::vector<Edge2d>& edges,
                double tolerance_px);

  // Edges whose own wedge (their disc has the same tolerance) meets `wedge`, in
  // ascending order of edge index.
  std::vector<std::int32_t> Meeting(const Wedge& wedge) const;

  // Calls f(edge index) for each of these edges, in no useful order.
  template <typename F>
  void VisitMeeting(const Wedge& wedge, const F& f) const {
    if (entries_.empty()) return;
    const double reach = wedge.half_width + max_half_width_;
    if (reach >= kPi) {  // all around: nearly along the baseline
      for (const Entry& entry : entries_) {
        if (Meet(wedge, entry)) f(entry.edge_idx);
      }
      return;
    }
    Visit(wedge, 0, f);
    if (wedge.center + reach > kPi) Visit(wedge, -2 * kPi, f);
    if (wedge.center - reach < -kPi) Visit(wedge, 2 * kPi, f);
  }

 private:
  struct Entry : Wedge {
    std::int32_t edge_idx = 0;
  };
  template <typename F>
  void Visit(const Wedge& wedge, double shift, const F& f) const {
    const double center = wedge.center + shift;
    const double reach = wedge.half_width + max_half_width_;
    const std::size_t end = begins_[Bucket(center + reach) + 1];
    for (std::size_t i = begins_[Bucket(center - reach)]; i < end; ++i) {
      const Entry& entry = entries_[i];
      if (std::abs(entry.center - center) <=
          wedge.half_width + entry.half_width) {
        f(entry.edge_idx);
      }
    }
  }
  // Of the same number as the edges, equally wide, over all their angles.
  std::size_t Bucket(double angle) const {
    const double bucket = (angle - least_angle_) * buckets_per_rad_;
    const double last = static_cast<double>(begins_.size()) - 2;
    return static_cast<std::size_t>(std::clamp(bucket, 0.0, last));
  }

  std::vector<Entry> entries_;       // by bucket, then edge index
  std::vector<std::size_t> begins_;  // of each bucket, and the end
  double least_angle_ = 0;
  double buckets_per_rad_ = 0;
  double max_half_width_ = 0;
};

}  // namespace curvix
