// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5, Fig. 6. The weighted neighborhood graph, step by step.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>

#include <vector>

#include "model/neighborhood_graph.h"
#include "model/posed_view.h"

namespace curvix {

// Which edges belong together: links of shared 2D edges, light ones pruned by
// the spread of all, united with the lifted tangential links, all pruned by
// their projections.
// Deviation: the paper prunes by projection before it adds the tangential
// links; these can err as well, where contours of different depth meet in an
// image.
NeighborhoodGraph LinkEdges(const std::vector<Edge3d>& edges,
                            const std::vector<EdgeMap>& edge_maps,
                            const std::vector<PosedView>& views,
                            const NeighborhoodOptions& options,
                            int num_threads);

}  // namespace curvix
