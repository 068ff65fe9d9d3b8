// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5. Links between 3D edges that share 2D edges, and between
// those that follow each other along image contours.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <vector>

#include "model/neighborhood_graph.h"

namespace curvix {

// Fig. 6(a): links every two 3D edges that are supported by a common 2D edge;
// num_shared is how many they have in common.
//
// Each edge asks for its `options.max_num_links` heaviest links only, the
// nearer and then the smaller index first among equals; a link stays if either
// end asks for it. So there are at most max_num_links links per edge on
// average, however many 3D edges one 2D edge supports.
// Deviation: the paper has no such limit. It drops the lightest links of
// crowded edges, which hardly change the alignment.
//
// Time: the sum over 2D edges of the square of the number of 3D edges that each
// supports.
NeighborhoodGraph BuildGraph(const std::vector<Edge3d>& edges,
                             const NeighborhoodOptions& options,
                             int num_threads);

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
