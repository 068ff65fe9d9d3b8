// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5 (i), Fig. 6(a).
#include "neighborhood/build_graph.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/parallel.h"
#include "neighborhood/heaviest_links.h"
#include "neighborhood/support_index.h"

namespace curvix {
namespace {

// All links of edge `i`, ascending.
std::vector<NeighborLink> SharedLinks(const std::vector<Edge3d>& edges,
                                      const SupportIndex& index,
                                      std::size_t i) {
  std::vector<std::int32_t> others;
  for (const EdgeRef& ref : edges[i].support) {
    const auto supported = index.SupportedBy(ref);
    others.insert(others.end(), supported.begin(), supported.end());
  }
  std::sort(others.begin(), others.end());
  std::vector<NeighborLink> row;
  for (const std::int32_t other : others) {
    if (static_cast<std::size_t>(other) == i) continue;
    if (row.empty() || row.back().edge_idx != other) row.push_back({other});
    ++row.back().num_shared;
  }
  return row;
}

}  // namespace

NeighborhoodGraph BuildGraph(const std::vector<Edge3d>& edges,
                             const NeighborhoodOptions& options,
                             int num_threads) {
  const SupportIndex index(edges);
  const auto max_num_links = static_cast<std::size_t>(options.max_num_links);
  std::vector<std::vector<NeighborLink>> rows(edges.size());
  ParallelFor(edges.size(), num_threads, [&](std::size_t i) {
    rows[i] =
        HeaviestLinks(edges, i, SharedLinks(edges, index, i), max_num_links);
    rows[i].shrink_to_fit();
  });
  return NeighborhoodGraph::FromRows(rows, num_threads);
}

}  // namespace curvix
