// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Bounds the number of links per edge.
#pragma once

#include <curvix/edges.h>

#include <cstddef>
#include <vector>

#include "model/neighborhood_graph.h"

namespace curvix {

// The `max_size` heaviest links of `row`, the row of edges[edge_idx], in
// ascending order of edge_idx. Among equal weights the nearer edge comes first,
// then the smaller index.
std::vector<NeighborLink> HeaviestLinks(const std::vector<Edge3d>& edges,
                                        std::size_t edge_idx,
                                        std::vector<NeighborLink> row,
                                        std::size_t max_size);

}  // namespace curvix
