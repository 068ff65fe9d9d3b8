// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/select_views.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/angles.h"

namespace curvix {
namespace {

constexpr double kMinShare = 0.25;  // of a view that its partner should see

bool IsSound(const ViewOverlap& overlap, const HypothesisOptions& options) {
  const double angle_deg = RadToDeg(overlap.ray_angle_rad);
  return overlap.share >= kMinShare && angle_deg >= options.min_ray_angle_deg &&
         angle_deg <= options.max_ray_angle_deg;
}

bool Contains(const std::vector<ViewPair>& pairs, const ViewPair& pair) {
  return std::ranges::any_of(pairs, [&](const ViewPair& other) {
    return std::minmax(other.h1, other.h2) == std::minmax(pair.h1, pair.h2);
  });
}

// H1 is the view with more unused edges; ties: the smaller index.
ViewPair InOrder(int a, int b, const std::vector<int>& num_unused_edges) {
  const int unused_a = num_unused_edges[static_cast<std::size_t>(a)];
  const int unused_b = num_unused_edges[static_cast<std::size_t>(b)];
  const bool a_first = unused_a != unused_b ? unused_a > unused_b : a < b;
  return a_first ? ViewPair{a, b} : ViewPair{b, a};
}

// Depth improves with the sine of the ray angle, what both views see shrinks
// with the angle: the product is flat between 15 and 30 degrees.
double Quality(const ViewOverlap& overlap) {
  const double angle = overlap.ray_angle_rad;
  const double scale = DegToRad(20);
  return overlap.share * (angle / scale) * std::exp(1 - angle / scale);
}

}  // namespace

std::optional<ViewPair> NextViewPair(const Overlaps& overlaps,
                                     const std::vector<int>& num_unused_edges,
                                     const std::vector<ViewPair>& done,
                                     const HypothesisOptions& options) {
  std::optional<ViewPair> best;
  std::tuple<int, int, int> best_rank;
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    for (const ViewOverlap& overlap : overlaps[i]) {
      const auto j = static_cast<std::size_t>(overlap.other);
      const int unused = num_unused_edges[i] + num_unused_edges[j];
      if (unused == 0 || !IsSound(overlap, options)) continue;
      const ViewPair pair =
          InOrder(static_cast<int>(i), overlap.other, num_unused_edges);
      const std::tuple rank(-unused, pair.h1, pair.h2);
      if ((best && !(rank < best_rank)) || Contains(done, pair)) continue;
      best = pair;
      best_rank = rank;
    }
  }
  return best;
}

std::vector<int> SelectPartners(const std::vector<ViewOverlap>& overlaps,
                                const HypothesisOptions& options) {
  std::vector<ViewOverlap> sound;
  for (const ViewOverlap& overlap : overlaps) {
    if (IsSound(overlap, options)) sound.push_back(overlap);
  }
  std::vector<double> quality;
  for (const ViewOverlap& overlap : sound) quality.push_back(Quality(overlap));

  std::vector<int> partners;
  while (static_cast<int>(partners.size()) < options.num_partners) {
    const auto best = std::ranges::max_element(quality);
    if (best == quality.end() || *best <= 0) break;
    const ViewOverlap chosen =
        sound[static_cast<std::size_t>(best - quality.begin())];
    partners.push_back(chosen.other);
    // A baseline parallel to a chosen one adds little, the chosen one nothing.
    for (std::size_t i = 0; i < sound.size(); ++i) {
      const double cosine =
          sound[i].baseline_across.dot(chosen.baseline_across);
      quality[i] *= 0.25 + 0.75 * std::sqrt(std::max(0.0, 1 - cosine * cosine));
    }
    *best = 0;
  }
  return partners;
}

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
