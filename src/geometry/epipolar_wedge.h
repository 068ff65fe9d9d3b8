// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(a). Epipolar wedges as intervals of epipolar angles.
#pragma once

#include <curvix/edges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/angles.h"
#include "geometry/epipolar.h"

namespace curvix {

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
