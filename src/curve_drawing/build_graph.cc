// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/build_graph.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <tuple>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"

namespace curvix {
namespace {

// A 2D edge and a 3D edge that it supports.
struct Support {
  EdgeRef ref;
  std::int32_t edge_idx = 0;
};

// All of them, by 2D edge, then by 3D edge.
std::vector<Support> AllSupports(const std::vector<Edge3d>& edges) {
  std::vector<Support> all;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (const EdgeRef& ref : edges[i].support) {
      all.push_back({ref, static_cast<std::int32_t>(i)});
    }
  }
  std::ranges::stable_sort(all, std::less<>(), &Support::ref);
  return all;
}

// The `max_size` heaviest links of `row`, the row of edges[edge_idx], in
// ascending order of edge_idx. Among equal weights the nearer edge comes first,
// then the smaller index.
std::vector<NeighborLink> HeaviestLinks(const std::vector<Edge3d>& edges,
                                        std::size_t edge_idx,
                                        std::vector<NeighborLink> row,
                                        std::size_t max_size) {
  if (row.size() <= max_size) return row;
  const auto rank = [&](const NeighborLink& link) {
    const Edge3d& other = edges[static_cast<std::size_t>(link.edge_idx)];
    const Eigen::Vector3d offset = other.position - edges[edge_idx].position;
    return std::tuple(-link.Weight(), offset.squaredNorm(), link.edge_idx);
  };
  const auto end = row.begin() + static_cast<std::ptrdiff_t>(max_size);
  std::ranges::nth_element(row, end, {}, rank);
  row.erase(end, row.end());
  std::ranges::sort(row, {}, &NeighborLink::edge_idx);
  return row;
}

const EdgeNeighbors& NeighborsOf(const std::vector<EdgeMap>& edge_maps,
                                 const EdgeRef& ref) {
  const auto view_idx = static_cast<std::size_t>(ref.view_idx);
  const auto edge_idx = static_cast<std::size_t>(ref.edge_idx);
  CURVIX_CHECK(view_idx < edge_maps.size() &&
                   edge_idx < edge_maps[view_idx].neighbors.size(),
               "view " << ref.view_idx << " has no edge " << ref.edge_idx);
  return edge_maps[view_idx].neighbors[edge_idx];
}

// Links each edge with those that the 2D edges `refs_of(ref)` of its supports
// support; `count` says how often.
template <typename RefsOf>
NeighborhoodGraph LinkBySupport(const std::vector<Edge3d>& edges,
                                const NeighborhoodOptions& options,
                                int num_threads,
                                std::int32_t NeighborLink::*count,
                                const RefsOf& refs_of) {
  const std::vector<Support> supports = AllSupports(edges);
  const auto max_num_links = static_cast<std::size_t>(options.max_num_links);
  std::vector<std::vector<NeighborLink>> rows(edges.size());
  ParallelFor(edges.size(), num_threads, [&](std::size_t i) {
    std::vector<std::int32_t> others;
    for (const EdgeRef& support : edges[i].support) {
      for (const EdgeRef& ref : refs_of(support)) {
        for (const Support& supported : std::ranges::equal_range(
                 supports, ref, std::less<>(), &Support::ref)) {
          others.push_back(supported.edge_idx);
        }
      }
    }
    std::ranges::sort(others);
    std::vector<NeighborLink> row;  // ascending
    for (const std::int32_t other : others) {
      if (static_cast<std::size_t>(other) == i) continue;
      if (row.empty() || row.back().edge_idx != other) row.push_back({other});
      ++(row.back().*count);
    }
    rows[i] = HeaviestLinks(edges, i, std::move(row), max_num_links);
    rows[i].shrink_to_fit();
  });
  return NeighborhoodGraph::FromRows(rows, num_threads);
}

}  // namespace

NeighborhoodGraph BuildGraph(const std::vector<Edge3d>& edges,
                             const NeighborhoodOptions& options,
                             int num_threads) {
  return LinkBySupport(edges,
                       options,
                       num_threads,
                       &NeighborLink::num_shared,
                       [](const EdgeRef& ref) { return std::array{ref}; });
}

NeighborhoodGraph LinkTangents(const std::vector<Edge3d>& edges,
                               const std::vector<EdgeMap>& edge_maps,
                               const NeighborhoodOptions& options,
                               int num_threads) {
  const auto refs_of = [&](const EdgeRef& ref) {
    std::vector<EdgeRef> refs;
    const EdgeNeighbors& neighbors = NeighborsOf(edge_maps, ref);
    for (const auto& neighbor : {neighbors.previous, neighbors.next}) {
      if (neighbor) refs.push_back({ref.view_idx, *neighbor});
    }
    return refs;
  };
  return LinkBySupport(
      edges, options, num_threads, &NeighborLink::num_tangential, refs_of);
}

}  // namespace curvix
