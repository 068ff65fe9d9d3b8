// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/select_validators.h"

#include <algorithm>
#include <iterator>

#include "base/angles.h"

namespace curvix {
namespace {

// A view that may be chosen and its ray angle to the nearest chosen one.
struct Candidate {
  int view_idx = 0;
  double angle_rad = kPi;
};

// Adds `view_idx` to the chosen views.
void Choose(const DistinctViews& views,
            int view_idx,
            std::vector<Candidate>& candidates,
            std::vector<int>& chosen) {
  chosen.push_back(view_idx);
  std::erase_if(candidates,
                [&](const Candidate& c) { return c.view_idx == view_idx; });
  const auto station_of = [&](int i) {
    return views.stations[static_cast<std::size_t>(i)];
  };
  for (Candidate& candidate : candidates) {
    if (station_of(candidate.view_idx) == station_of(view_idx)) {
      candidate.angle_rad = 0;
    }
  }
  // Both are in the order of views.
  auto candidate = candidates.begin();
  for (const ViewOverlap& overlap :
       views.overlaps[static_cast<std::size_t>(view_idx)]) {
    while (candidate != candidates.end() &&
           candidate->view_idx < overlap.other) {
      ++candidate;
    }
    if (candidate == candidates.end()) return;
    if (candidate->view_idx == overlap.other) {
      candidate->angle_rad =
          std::min(candidate->angle_rad, overlap.ray_angle_rad);
    }
  }
}

}  // namespace

std::vector<int> SelectValidators(const DistinctViews& views,
                                  int h1,
                                  const std::vector<int>& partners,
                                  int max_num) {
  const Overlaps& overlaps = views.overlaps;
  std::vector<int> chosen;
  if (overlaps.size() <= static_cast<std::size_t>(max_num)) {
    for (std::size_t i = 0; i < overlaps.size(); ++i) {
      if (!views.are_repeated[i]) chosen.push_back(static_cast<int>(i));
    }
    return chosen;
  }
  std::vector<Candidate> candidates;
  for (const ViewOverlap& overlap : overlaps[static_cast<std::size_t>(h1)]) {
    candidates.push_back({overlap.other, kPi});
  }
  Choose(views, h1, candidates, chosen);
  for (const int partner : partners) {
    Choose(views, partner, candidates, chosen);
  }
  while (!candidates.empty() && static_cast<int>(chosen.size()) < max_num) {
    const auto best =
        std::ranges::max_element(candidates, {}, &Candidate::angle_rad);
    Choose(views, best->view_idx, candidates, chosen);
  }
  // These are queried in their stead where they see an edge.
  for (const int view_idx : std::vector<int>(chosen)) {
    const std::vector<int>& before =
        views.before_at_station[static_cast<std::size_t>(view_idx)];
    chosen.insert(chosen.end(), before.begin(), before.end());
  }
  std::ranges::sort(chosen);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

Overlaps OverlapsAmong(const Overlaps& overlaps,
                       const std::vector<int>& chosen) {
  Overlaps among(overlaps.size());
  for (const int view_idx : chosen) {
    const auto i = static_cast<std::size_t>(view_idx);
    for (const int other : chosen) {
      if (const ViewOverlap* overlap = OverlapWith(overlaps[i], other)) {
        among[i].push_back(*overlap);
      }
    }
  }
  return among;
}

}  // namespace curvix
