// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5, Fig. 6(b)-(d).
#include "neighborhood/prune_by_spread.h"

#include <Eigen/Core>
#include <cstddef>

#include "base/parallel.h"

namespace curvix {
namespace {

using Triple = Eigen::Array3d;  // normal, tangential, angle

Triple AsTriple(const EdgeDistances& distances) {
  return {distances.normal, distances.tangential, distances.angle};
}

// The sum of f(distances) over all links; the same for any number of threads.
template <typename F>
Triple SumOverLinks(const std::vector<Edge3d>& edges,
                    const NeighborhoodGraph& graph,
                    int num_threads,
                    const F& f) {
  std::vector<Triple> of_rows(graph.NumEdges(), Triple::Zero());
  ParallelFor(graph.NumEdges(), num_threads, [&](std::size_t i) {
    for (const NeighborLink& link : graph.Neighbors(i)) {
      const auto j = static_cast<std::size_t>(link.edge_idx);
      if (j < i) continue;
      of_rows[i] += f(AsTriple(MeasureDistances(edges[i], edges[j])));
    }
  });
  Triple sum = Triple::Zero();
  for (const Triple& of_row : of_rows) sum += of_row;
  return sum;
}

}  // namespace

EdgeDistances SpreadLimits(const std::vector<Edge3d>& edges,
                           const NeighborhoodGraph& graph,
                           double lambda,
                           int num_threads) {
  if (graph.NumLinks() == 0) return {};
  const auto num_links = static_cast<double>(graph.NumLinks());
  const Triple mean = SumOverLinks(edges,
                                   graph,
                                   num_threads,
                                   [](const Triple& value) { return value; }) /
                      num_links;
  const Triple squares =
      SumOverLinks(edges, graph, num_threads, [&](const Triple& value) {
        return Triple((value - mean).square());
      });
  const Triple limit = mean + lambda * (squares / num_links).sqrt();
  return {limit[0], limit[1], limit[2]};
}

NeighborhoodGraph PruneBySpread(const std::vector<Edge3d>& edges,
                                const NeighborhoodGraph& graph,
                                const NeighborhoodOptions& options,
                                int num_threads) {
  const Triple limits =
      AsTriple(SpreadLimits(edges, graph, options.max_spread, num_threads));
  const auto keep = [&](std::size_t i, const NeighborLink& link) {
    if (link.Weight() > 1) return true;
    const Edge3d& other = edges[static_cast<std::size_t>(link.edge_idx)];
    return (AsTriple(MeasureDistances(edges[i], other)) <= limits).all();
  };
  return graph.Filter(keep, num_threads);
}

}  // namespace curvix
