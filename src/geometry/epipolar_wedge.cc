// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(a).
#include "geometry/epipolar_wedge.h"

#include <algorithm>
#include <cmath>

namespace curvix {

std::optional<Wedge> WedgeOf(const EpipolarPencil& pencil,
                             const PosedView& view,
                             const Eigen::Vector2d& pixel,
                             double tolerance_px) {
  const auto angle = pencil.AngleOf(view, pixel);
  if (!angle) return std::nullopt;
  return Wedge{angle->angle, tolerance_px * angle->rad_per_px};
}

bool Meet(const Wedge& a, const Wedge& b) {
  return std::abs(std::remainder(a.center - b.center, 2 * kPi)) <=
         a.half_width + b.half_width;
}

SortedByAngle::SortedByAngle(const EpipolarPencil& pencil,
                             const PosedView& view,
                             const std::vector<Edge2d>& edges,
                             double tolerance_px) {
  entries_.reserve(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto wedge = WedgeOf(pencil, view, edges[i].position, tolerance_px);
    if (!wedge) continue;
    entries_.push_back(
        {wedge->center, wedge->half_width, static_cast<std::int32_t>(i)});
    max_half_width_ = std::max(max_half_width_, wedge->half_width);
  }
  std::stable_sort(
      entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.angle < b.angle;
      });
}

std::vector<std::int32_t> SortedByAngle::Meeting(const Wedge& wedge) const {
  std::vector<std::int32_t> found;
  VisitMeeting(wedge,
               [&](std::size_t i) { found.push_back(entries_[i].edge_idx); });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::int32_t> SortedByAngle::EdgeIdxs() const {
  std::vector<std::int32_t> edge_idxs;
  edge_idxs.reserve(entries_.size());
  for (const Entry& entry : entries_) edge_idxs.push_back(entry.edge_idx);
  return edge_idxs;
}

}  // namespace curvix
