// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5 (ii). Links between 3D edges that follow each other along an
// image contour.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>

#include <vector>

#include "model/neighborhood_graph.h"

namespace curvix {

// Links two 3D edges if one has a 2D edge whose previous or next neighbour
// supports the other; num_tangential is in how many views. The full
// neighborhood graph is UnionOf(this, the links of shared 2D edges).
//
// Each edge asks for its options.max_num_links heaviest links, as in
// BuildGraph. `edge_maps` has one map per view, with the neighbours of each
// edge.
NeighborhoodGraph LinkTangents(const std::vector<Edge3d>& edges,
                               const std::vector<EdgeMap>& edge_maps,
                               const NeighborhoodOptions& options,
                               int num_threads);

}  // namespace curvix
