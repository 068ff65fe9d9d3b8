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
  std::vector<std::int32_t> first;   // none links to one before it
  std::vector<std::int32_t> second;  // each links to one of `first`
};

// Splits `edge_idxs`, in their order; `neighbors` by edge index. Takes
// O(edges).
TwoTurns SplitAlongContours(const std::vector<std::int32_t>& edge_idxs,
                            const std::vector<EdgeNeighbors>& neighbors);

}  // namespace curvix
