// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What validation needs of all views, made once.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <vector>

#include "edge_sketch/evidence.h"
#include "edge_sketch/view_index.h"
#include "edge_sketch/view_overlap.h"
#include "model/posed_view.h"

namespace curvix {

// One index per view; both vectors must outlive them.
std::vector<ViewIndex> IndexViews(const std::vector<PosedView>& views,
                                  const std::vector<EdgeMap>& edge_maps,
                                  int num_threads);

// Adds to each index the `presence` for searches with `options`.
void AddPresence(const ValidationOptions& options,
                 int num_threads,
                 std::vector<ViewIndex>& indices);

// Of each view the nearest in direction, nearest first, with the weights of
// their votes.
std::vector<std::vector<ViewNeighbor>> NeighborsInDirection(
    const std::vector<std::vector<ViewOverlap>>& overlaps);

}  // namespace curvix
