// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/link_edges.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <tuple>
#include <utility>

#include "base/check.h"
#include "base/infinity.h"
#include "base/parallel.h"

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
        for (auto it = std::ranges::lower_bound(
                 supports, ref, std::less<>(), &Support::ref);
             it != supports.end() && it->ref == ref;
             ++it) {
          others.push_back(it->edge_idx);
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

namespace {

// A 3D edge in a view that supports it; the pixel is not finite behind the
// camera.
struct Projection {
  std::int32_t view_idx = 0;
  Eigen::Vector2d pixel;
};

// Into all supporting views, ascending.
std::vector<Projection> Project(const Edge3d& edge,
                                const std::vector<PosedView>& views) {
  std::vector<Projection> projections;
  projections.reserve(edge.support.size());
  for (const EdgeRef& ref : edge.support) {
    const auto view_idx = static_cast<std::size_t>(ref.view_idx);
    CURVIX_CHECK(view_idx < views.size(), "there is no view " << ref.view_idx);
    const PosedView& view = views[view_idx];
    const Eigen::Vector3d in_camera = view.InCamera(edge.position);
    const bool is_in_front = in_camera.z() > 0;
    projections.push_back({ref.view_idx,
                           is_in_front
                               ? view.Pixel(in_camera)
                               : Eigen::Vector2d::Constant(kInfinity).eval()});
  }
  return projections;
}

// Whether the projections are close in all views that support both edges.
bool AreClose(const std::vector<Projection>& a,
              const std::vector<Projection>& b,
              double max_distance_px) {
  auto x = a.begin();
  auto y = b.begin();
  while (x != a.end() && y != b.end()) {
    if (x->view_idx != y->view_idx) {
      (x->view_idx < y->view_idx) ? ++x : ++y;
      continue;
    }
    if (!((x->pixel - y->pixel).norm() <= max_distance_px)) return false;
    ++x;
    ++y;
  }
  return true;
}

}  // namespace

NeighborhoodGraph PruneByProjection(const std::vector<Edge3d>& edges,
                                    const NeighborhoodGraph& graph,
                                    const std::vector<PosedView>& views,
                                    const NeighborhoodOptions& options,
                                    int num_threads) {
  std::vector<std::vector<Projection>> projections(edges.size());
  ParallelFor(edges.size(), num_threads, [&](std::size_t i) {
    projections[i] = Project(edges[i], views);
  });
  const auto keep = [&](std::size_t i, const NeighborLink& link) {
    return AreClose(projections[i],
                    projections[static_cast<std::size_t>(link.edge_idx)],
                    options.max_projection_distance_px);
  };
  return graph.Filter(keep, num_threads);
}

}  // namespace curvix
