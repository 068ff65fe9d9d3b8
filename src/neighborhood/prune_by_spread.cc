// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5, Fig. 6(b)-(d).
#include "neighborhood/prune_by_spread.h"

#include <Eigen/Core>
#include <cstddef>

namespace curvix {
namespace {

using Triple = Eigen::Array3d;  // normal, tangential, angle

Triple AsTriple(const EdgeDistances& distances) {
  return {distances.normal, distances.tangential, distances.angle};
}

// Calls visit(distances) for every link, in order.
template <typename Visit>
void ForEachLink(const std::vector<Edge3d>& edges,
                 const NeighborhoodGraph& graph,
                 const Visit& visit) {
  for (std::size_t i = 0; i < graph.NumEdges(); ++i) {
    for (const NeighborLink& link : graph.Neighbors(i)) {
      const auto j = static_cast<std::size_t>(link.edge_idx);
      if (j > i) visit(AsTriple(MeasureDistances(edges[i], edges[j])));
    }
  }
}

}  // namespace

EdgeDistances SpreadLimits(const std::vector<Edge3d>& edges,
                           const NeighborhoodGraph& graph,
                           double lambda) {
  if (graph.NumLinks() == 0) return {};
  const auto num_links = static_cast<double>(graph.NumLinks());
  Triple sum = Triple::Zero();
  ForEachLink(edges, graph, [&](const Triple& value) { sum += value; });
  const Triple mean = sum / num_links;
  Triple squares = Triple::Zero();
  ForEachLink(edges, graph, [&](const Triple& value) {
    squares += (value - mean).square();
  });
  const Triple limit = mean + lambda * (squares / num_links).sqrt();
  return {limit[0], limit[1], limit[2]};
}

NeighborhoodGraph PruneBySpread(const std::vector<Edge3d>& edges,
                                const NeighborhoodGraph& graph,
                                const NeighborhoodOptions& options,
                                int num_threads) {
  const Triple limits =
      AsTriple(SpreadLimits(edges, graph, options.max_spread));
  const auto keep = [&](std::size_t i, const NeighborLink& link) {
    if (link.Weight() > 1) return true;
    const Edge3d& other = edges[static_cast<std::size_t>(link.edge_idx)];
    return (AsTriple(MeasureDistances(edges[i], other)) <= limits).all();
  };
  return graph.Filter(keep, num_threads);
}

}  // namespace curvix
