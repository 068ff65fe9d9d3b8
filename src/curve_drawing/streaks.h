// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Which views support a growing curve steadily.
#pragma once

#include <curvix/edges.h>
#include <cstddef>
#include <vector>

namespace curvix {

// The views that supported the last samples of a curve.
class Streaks {
 public:
  // Hits and misses in a row that count.
  static constexpr int kLength = 3;

  // Those of the seed's support are trusted from the start, the others after
  // three hits in a row; three misses in a row end it.
  Streaks(std::size_t num_views, const std::vector<EdgeRef>& seed_support)
      : streaks_(num_views) {
    for (const EdgeRef& ref : seed_support) {
      streaks_[static_cast<std::size_t>(ref.view_idx)].is_trusted = true;
    }
  }

  // Adds the view's result for the next sample. Whether it is a hit of a
  // trusted view.
  bool Count(std::size_t view_idx, bool is_hit) {
    Streak& streak = streaks_[view_idx];
    streak.length = streak.is_of_hits == is_hit ? streak.length + 1 : 1;
    streak.is_of_hits = is_hit;
    if (streak.length >= kLength) streak.is_trusted = is_hit;
    return is_hit && streak.is_trusted;
  }

 private:
  struct Streak {
    bool is_of_hits = false;
    int length = 0;
    bool is_trusted = false;
  };
  std::vector<Streak> streaks_;
};

}  // namespace curvix
