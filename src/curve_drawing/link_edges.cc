// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/link_edges.h"

#include <Eigen/Core>
#include <cstddef>

#include "base/check.h"
#include "base/infinity.h"
#include "base/parallel.h"
#include "curve_drawing/build_graph.h"

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

double ProjectedDistance(const PosedView& view,
                         const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b) {
  const Eigen::Vector3d a_cam = view.InCamera(a);
  const Eigen::Vector3d b_cam = view.InCamera(b);
  if (!(a_cam.z() > 0) || !(b_cam.z() > 0)) {
    return kInfinity;
  }
  return (view.Pixel(a_cam) - view.Pixel(b_cam)).norm();
}

// Whether the projections are close in all views that support both.
bool AreCloseInAllViews(const Edge3d& a,
                        const Edge3d& b,
                        const std::vector<PosedView>& views,
                        double max_distance_px) {
  auto x = a.support.begin();
  auto y = b.support.begin();
  while (x != a.support.end() && y != b.support.end()) {
    if (x->view_idx != y->view_idx) {
      (x->view_idx < y->view_idx) ? ++x : ++y;
      continue;
    }
    const auto view_idx = static_cast<std::size_t>(x->view_idx);
    CURVIX_CHECK(view_idx < views.size(), "there is no view " << view_idx);
    if (ProjectedDistance(views[view_idx], a.position, b.position) >
        max_distance_px) {
      return false;
    }
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
  const auto keep = [&](std::size_t i, const NeighborLink& link) {
    const Edge3d& other = edges[static_cast<std::size_t>(link.edge_idx)];
    return AreCloseInAllViews(
        edges[i], other, views, options.max_projection_distance_px);
  };
  return graph.Filter(keep, num_threads);
}

}  // namespace curvix
