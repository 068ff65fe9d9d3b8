// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5 (ii).
#include "neighborhood/link_tangents.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/check.h"
#include "base/parallel.h"
#include "neighborhood/heaviest_links.h"
#include "neighborhood/support_index.h"

namespace curvix {
namespace {

const EdgeNeighbors& NeighborsOf(const std::vector<EdgeMap>& edge_maps,
                                 const EdgeRef& ref) {
  const auto view_idx = static_cast<std::size_t>(ref.view_idx);
  const auto edge_idx = static_cast<std::size_t>(ref.edge_idx);
  CURVIX_CHECK(view_idx < edge_maps.size() &&
                   edge_idx < edge_maps[view_idx].neighbors.size(),
               "view " << ref.view_idx << " has no edge " << ref.edge_idx);
  return edge_maps[view_idx].neighbors[edge_idx];
}

// The links that start at the 2D edges of edge `i`, ascending.
std::vector<NeighborLink> LiftedLinks(const std::vector<Edge3d>& edges,
                                      const std::vector<EdgeMap>& edge_maps,
                                      const SupportIndex& index,
                                      std::size_t i) {
  std::vector<std::int32_t> others;
  for (const EdgeRef& ref : edges[i].support) {
    const EdgeNeighbors& neighbors = NeighborsOf(edge_maps, ref);
    for (const auto& neighbor : {neighbors.previous, neighbors.next}) {
      if (!neighbor.has_value()) continue;
      const auto supported = index.SupportedBy({ref.view_idx, *neighbor});
      others.insert(others.end(), supported.begin(), supported.end());
    }
  }
  std::sort(others.begin(), others.end());
  std::vector<NeighborLink> row;
  for (const std::int32_t other : others) {
    if (static_cast<std::size_t>(other) == i) continue;
    if (row.empty() || row.back().edge_idx != other) row.push_back({other});
    ++row.back().num_tangential;
  }
  return row;
}

}  // namespace

NeighborhoodGraph LinkTangents(const std::vector<Edge3d>& edges,
                               const std::vector<EdgeMap>& edge_maps,
                               const NeighborhoodOptions& options,
                               int num_threads) {
  const SupportIndex index(edges);
  const auto max_num_links = static_cast<std::size_t>(options.max_num_links);
  std::vector<std::vector<NeighborLink>> rows(edges.size());
  ParallelFor(edges.size(), num_threads, [&](std::size_t i) {
    rows[i] = HeaviestLinks(
        edges, i, LiftedLinks(edges, edge_maps, index, i), max_num_links);
    rows[i].shrink_to_fit();
  });
  return NeighborhoodGraph::FromRows(rows, num_threads);
}

}  // namespace curvix
