// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(a).
#include "geometry/epipolar_wedge.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/angles.h"

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
  std::sort(
      entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return std::tie(a.angle, a.edge_idx) < std::tie(b.angle, b.edge_idx);
      });
}

void SortedByAngle::Collect(const Wedge& wedge,
                            double shift,
                            std::vector<std::int32_t>& found) const {
  const double center = wedge.center + shift;
  const double reach = wedge.half_width + max_half_width_;
  auto entry = std::lower_bound(
      entries_.begin(),
      entries_.end(),
      center - reach,
      [](const Entry& e, double angle) { return e.angle < angle; });
  for (; entry != entries_.end() && entry->angle <= center + reach; ++entry) {
    if (std::abs(entry->angle - center) <=
        wedge.half_width + entry->half_width) {
      found.push_back(entry->edge_idx);
    }
  }
}

std::vector<std::int32_t> SortedByAngle::Meeting(const Wedge& wedge) const {
  std::vector<std::int32_t> found;
  const double reach = wedge.half_width + max_half_width_;
  Collect(wedge, 0, found);
  if (wedge.center + reach > kPi) Collect(wedge, -2 * kPi, found);
  if (wedge.center - reach < -kPi) Collect(wedge, 2 * kPi, found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace curvix
