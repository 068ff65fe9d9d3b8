// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5 (i), Fig. 6(a). Links between 3D edges that share 2D edges.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>

#include <vector>

#include "model/neighborhood_graph.h"

namespace curvix {

// Links every two 3D edges that are supported by a common 2D edge; num_shared
// is how many they have in common.
//
// Each edge asks for its `options.max_num_links` heaviest links only, the
// nearer and then the smaller index first among equals; a link stays if either
// end asks for it. So there are at most max_num_links links per edge on
// average, however many 3D edges lean on one 2D edge.
// Deviation: the paper has no such limit. What it drops are the lightest links
// of crowded edges, which the alignment hardly feels.
//
// Time: the sum over 2D edges of the square of the number of 3D edges that each
// supports.
NeighborhoodGraph BuildGraph(const std::vector<Edge3d>& edges,
                             const NeighborhoodOptions& options,
                             int num_threads);

}  // namespace curvix
