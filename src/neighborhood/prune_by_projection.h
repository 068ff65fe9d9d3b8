// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5, Fig. 6(e). Prunes links by the distance of projections.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>

#include <vector>

#include "model/neighborhood_graph.h"
#include "model/posed_view.h"

namespace curvix {

// `graph` without the links whose edges project more than tau_gamma =
// options.max_projection_distance_px apart in any view that sees both. A view
// sees an edge if one of its 2D edges supports it: in other views something may
// hide it, and what they would show says nothing. Edges behind a camera that
// supports them are at an infinite distance. Links between edges that no view
// sees both of stay.
NeighborhoodGraph PruneByProjection(const std::vector<Edge3d>& edges,
                                    const NeighborhoodGraph& graph,
                                    const std::vector<PosedView>& views,
                                    const NeighborhoodOptions& options,
                                    int num_threads);

}  // namespace curvix
