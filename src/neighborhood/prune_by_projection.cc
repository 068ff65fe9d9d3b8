// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5, Fig. 6(e).
#include "neighborhood/prune_by_projection.h"

#include <cstddef>
#include <limits>

#include "base/check.h"

namespace curvix {
namespace {

double ProjectedDistance(const PosedView& view,
                         const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b) {
  const Eigen::Vector3d a_cam = view.InCamera(a);
  const Eigen::Vector3d b_cam = view.InCamera(b);
  if (!(a_cam.z() > 0) || !(b_cam.z() > 0)) {
    return std::numeric_limits<double>::infinity();
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
