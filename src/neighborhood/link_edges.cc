// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5, Fig. 6.
#include "neighborhood/link_edges.h"

#include "neighborhood/build_graph.h"
#include "neighborhood/link_tangents.h"
#include "neighborhood/prune_by_projection.h"
#include "neighborhood/prune_by_spread.h"

namespace curvix {

NeighborhoodGraph LinkEdges(const std::vector<Edge3d>& edges,
                            const std::vector<EdgeMap>& edge_maps,
                            const std::vector<PosedView>& views,
                            const NeighborhoodOptions& options,
                            int num_threads) {
  const NeighborhoodGraph shared = PruneBySpread(
      edges, BuildGraph(edges, options, num_threads), options, num_threads);
  const NeighborhoodGraph tangential =
      LinkTangents(edges, edge_maps, options, num_threads);
  return PruneByProjection(edges,
                           UnionOf(shared, tangential, num_threads),
                           views,
                           options,
                           num_threads);
}

}  // namespace curvix
