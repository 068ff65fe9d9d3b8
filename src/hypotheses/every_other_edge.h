// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Which edges of a view ask for hypotheses.
#pragma once

#include <curvix/edges.h>

#include <cstdint>
#include <vector>

namespace curvix {

// Of `edge_idxs`, in their order, those that do not link to one before them
// that was taken: every other edge along a contour. Neighbours along a contour
// mostly have the same fate, and curves grow over those between. `neighbors` by
// edge index. Takes O(edges).
std::vector<std::int32_t> EveryOtherAlongContours(
    const std::vector<std::int32_t>& edge_idxs,
    const std::vector<EdgeNeighbors>& neighbors);

}  // namespace curvix
