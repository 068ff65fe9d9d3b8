// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The samples of a growing curve.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/edge_geometry.h"

namespace curvix {

// Fewest views that support a sample.
inline constexpr std::size_t kMinNumSupports = 3;

struct GrownSample {
  SpaceEdge edge;
  double sigma = 0;            // world units
  double evidence = 0;         // log-likelihood ratio
  std::vector<EdgeRef> hits;   // ascending
  std::int64_t num_looks = 0;  // queries
};

// The views that supported the last samples of a curve.
class Streaks {
 public:
  // Those of the seed's support are trusted from the start, the others after
  // three hits in a row; three misses in a row end it.
  Streaks(std::size_t num_views, const std::vector<EdgeRef>& seed_support);

  // Adds the view's result for the next sample. Whether it is a hit of a
  // trusted view.
  bool Count(std::size_t view_idx, bool is_hit);

 private:
  struct Streak {
    bool is_of_hits = false;
    int length = 0;
    bool is_trusted = false;
  };
  std::vector<Streak> streaks_;
};

// Leaves out the hits of a view in fewer than three samples; one miss in
// between does not end a streak.
void DropShortStreaks(std::size_t num_views, std::vector<GrownSample>& path);

// Trims both ends to samples with kMinNumSupports supports.
void TrimEnds(std::vector<GrownSample>& path);

CurveSample ToCurveSample(GrownSample grown);

}  // namespace curvix
