// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5, Fig. 6(b)-(d). Prunes light links by the spread of all.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>

#include <vector>

#include "geometry/edge_distances.h"
#include "model/neighborhood_graph.h"

namespace curvix {

// mu + lambda sigma of each distance over all links of `graph`. The same for
// any number of threads. All zero without links.
EdgeDistances SpreadLimits(const std::vector<Edge3d>& edges,
                           const NeighborhoodGraph& graph,
                           double lambda,
                           int num_threads);

// `graph` without the links of weight one that exceed any of the limits above,
// with lambda = options.max_spread. The paper does not say over which links it
// takes mu and sigma; here over all of them, as those of weight one alone are
// the ones in doubt.
NeighborhoodGraph PruneBySpread(const std::vector<Edge3d>& edges,
                                const NeighborhoodGraph& graph,
                                const NeighborhoodOptions& options,
                                int num_threads);

}  // namespace curvix
