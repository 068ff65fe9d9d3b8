// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Which edges of a view ask for hypotheses first.
#pragma once

#include <curvix/edges.h>
#include <cstdint>
#include <vector>

namespace curvix {

// Edges that ask in two turns. Neighbours along a contour mostly have the same
// fate: what the first turn finds tells which edges of the second are worth
// their cost.
struct TwoTurns {
  // Fewer than `step` links lead from none of them to one before it,
  std::vector<std::int32_t> first;
  // and from each of these to one of `first`.
  std::vector<std::int32_t> second;
};

// Splits `edge_idxs`, in their order; `neighbors` by edge index; `step` >= 2.
// Takes O(edges * step).
TwoTurns SplitAlongContours(const std::vector<std::int32_t>& edge_idxs,
                            const std::vector<EdgeNeighbors>& neighbors,
                            int step);

}  // namespace curvix
