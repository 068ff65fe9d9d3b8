// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3. Chooses hypothesis views H1 and H2 and, beyond the paper, the
// query views of their hypotheses.
#pragma once

#include <curvix/options.h>
#include <optional>
#include <vector>

#include "edge_sketch/view_overlap.h"

namespace curvix {

struct ViewPair {
  int h1 = 0;  // view_idx
  int h2 = 0;  // view_idx
};

// The paper's choice: of the pairs whose overlap and ray angle are sound and
// that are not in `done`, the one with most unused edges in both views
// together; ties: smaller h1, then smaller h2. H1 is the view with more unused
// edges; ties: the smaller index. nullopt when no pair with an unused edge is
// left.
std::optional<ViewPair> NextViewPair(const Overlaps& overlaps,
                                     const std::vector<int>& num_unused_edges,
                                     const std::vector<ViewPair>& done,
                                     const HypothesisOptions& options);

// Deviation: every view as H1. Its partners, best first, at most
// options.num_partners. They overlap it, at ray angles that give depth without
// hiding what is seen, and their baselines differ in direction, because an edge
// along the epipolar lines of one pair gets its depth from another.
std::vector<int> SelectPartners(const std::vector<ViewOverlap>& overlaps,
                                const HypothesisOptions& options);

// More query views cost time and change little.
inline constexpr int kMaxNumValidators = 64;

// All distinct views, if there are at most `max_num` (>= 1) views in all. Else
// h1, its `partners`, and of the views that overlap h1 those that differ most
// in direction, max_num in all: repeatedly the view with the largest ray angle
// to the nearest view chosen so far; ties: the smaller index. Besides, those
// before them at their stations. Ascending.
std::vector<int> SelectValidators(const DistinctViews& views,
                                  int h1,
                                  const std::vector<int>& partners,
                                  int max_num = kMaxNumValidators);

// The overlaps among the views of `chosen` (ascending); none for other views.
Overlaps OverlapsAmong(const Overlaps& overlaps,
                       const std::vector<int>& chosen);

}  // namespace curvix
