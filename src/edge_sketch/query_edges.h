// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The edges of a view for which hypotheses are made,
// and their order.
#pragma once

#include <curvix/edges.h>
#include <cstdint>
#include <vector>

#include "edge_sketch/sketch_input.h"

namespace curvix {

// For each edge whether it may become a seed: it is not texture
// (CurveGrowthOptions::IsTexture), and its contour is strong enough for a
// curve, since the strengths of its edges sum to at least
// EdgeDetectionOptions::min_contour_edges times the median strength. Mutual
// links join the edges of a contour.
std::vector<bool> AreSeedCandidates(const EdgeMap& map, const Options& options);

// One in input.h1_step of the unused edges of a view; for seeds only
// candidates. Ascending.
std::vector<std::int32_t> QueryEdges(const SketchInput& input,
                                     int view_idx,
                                     const UsedEdges& used);

// Number of links along a contour from one query edge to the next: two, four in
// crowded images, eight for seeds.
int LinksBetweenQueries(const SketchInput& input);

// Edges that are queried in two turns. Neighbours along a contour mostly have
// the same result, so the first turn tells which edges of the second are worth
// it.
struct TwoTurns {
  // At least `step` links apart along their contours.
  std::vector<std::int32_t> first;
  // Fewer than `step` links from an edge of `first`.
  std::vector<std::int32_t> second;
};

// Splits `edge_idxs`, in their order; `neighbors` by edge index; `step` >= 2.
// Takes O(edges * step).
TwoTurns SplitAlongContours(const std::vector<std::int32_t>& edge_idxs,
                            const std::vector<EdgeNeighbors>& neighbors,
                            int step);

}  // namespace curvix
