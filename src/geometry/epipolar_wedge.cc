// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/epipolar_wedge.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace curvix {

std::optional<Wedge> WedgeOf(const EpipolarAngles& angles,
                             const Eigen::Vector2d& pixel,
                             double tolerance_px) {
  const auto angle = angles.AngleOf(pixel);
  if (!angle) return std::nullopt;
  return Wedge{angle->angle, tolerance_px * angle->rad_per_px};
}

bool Meet(const Wedge& a, const Wedge& b) {
  return std::abs(std::remainder(a.center - b.center, 2 * kPi)) <=
         a.half_width + b.half_width;
}

SortedByAngle::SortedByAngle(const EpipolarAngles& angles,
                             const std::vector<Edge2d>& edges,
                             double tolerance_px) {
  std::vector<Entry> entries;
  entries.reserve(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto wedge = WedgeOf(angles, edges[i].position, tolerance_px);
    if (!wedge) continue;
    entries.push_back({*wedge, static_cast<std::int32_t>(i)});
    max_half_width_ = std::max(max_half_width_, wedge->half_width);
  }
  if (entries.empty()) return;
  const auto [least, largest] =
      std::ranges::minmax_element(entries, {}, &Entry::center);
  const auto size = static_cast<double>(entries.size());
  least_angle_ = least->center;
  if (largest->center > least_angle_) {
    buckets_per_rad_ = size / (largest->center - least_angle_);
  }
  // Counting sort.
  begins_.assign(entries.size() + 1, 0);
  for (const Entry& entry : entries) ++begins_[Bucket(entry.center) + 1];
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
  entries_.resize(entries.size());
  for (const Entry& entry : entries) {
    entries_[next[Bucket(entry.center)]++] = entry;
  }
}

std::vector<std::int32_t> SortedByAngle::Meeting(const Wedge& wedge) const {
  std::vector<std::int32_t> found;
  VisitMeeting(wedge,
               [&](std::int32_t edge_idx) { found.push_back(edge_idx); });
  std::ranges::sort(found);
  return found;
}

}  // namespace curvix
