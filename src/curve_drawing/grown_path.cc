// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/grown_path.h"

#include <algorithm>
#include <utility>

namespace curvix {
namespace {

// Hits and misses in a row that count.
constexpr int kStreak = 3;

void DropHit(GrownSample& grown, std::size_t view_idx) {
  std::erase_if(grown.hits, [&](const EdgeRef& hit) {
    return static_cast<std::size_t>(hit.view_idx) == view_idx;
  });
}

}  // namespace

Streaks::Streaks(std::size_t num_views,
                 const std::vector<EdgeRef>& seed_support)
    : streaks_(num_views) {
  for (const EdgeRef& ref : seed_support) {
    streaks_[static_cast<std::size_t>(ref.view_idx)].is_trusted = true;
  }
}

bool Streaks::Count(std::size_t view_idx, bool is_hit) {
  Streak& streak = streaks_[view_idx];
  streak.length = streak.is_of_hits == is_hit ? streak.length + 1 : 1;
  streak.is_of_hits = is_hit;
  if (streak.length >= kStreak) streak.is_trusted = is_hit;
  return is_hit && streak.is_trusted;
}

void DropShortStreaks(std::size_t num_views, std::vector<GrownSample>& path) {
  std::vector<std::vector<std::size_t>> hit_samples(num_views);
  for (std::size_t k = 0; k < path.size(); ++k) {
    for (const EdgeRef& hit : path[k].hits) {
      hit_samples[static_cast<std::size_t>(hit.view_idx)].push_back(k);
    }
  }
  for (std::size_t v = 0; v < hit_samples.size(); ++v) {
    const std::vector<std::size_t>& samples = hit_samples[v];
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= samples.size(); ++i) {
      if (i < samples.size() && samples[i] <= samples[i - 1] + 2) continue;
      if (i - begin < static_cast<std::size_t>(kStreak)) {
        for (std::size_t j = begin; j < i; ++j) DropHit(path[samples[j]], v);
      }
      begin = i;
    }
  }
}

void TrimEnds(std::vector<GrownSample>& path) {
  const auto is_shown = [](const GrownSample& grown) {
    return grown.hits.size() >= kMinNumSupports;
  };
  path.erase(std::find_if(path.rbegin(), path.rend(), is_shown).base(),
             path.end());
  path.erase(path.begin(), std::ranges::find_if(path, is_shown));
}

CurveSample ToCurveSample(GrownSample grown) {
  CurveSample sample;
  sample.position = grown.edge.position;
  sample.tangent = grown.edge.tangent;
  sample.evidence = grown.evidence;
  sample.sigma = grown.sigma;
  sample.support = std::move(grown.hits);
  return sample;
}

}  // namespace curvix
