// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The order in which edges of a view are queried.
#pragma once

#include <curvix/edges.h>
#include <cstdint>
#include <vector>

namespace curvix {

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
