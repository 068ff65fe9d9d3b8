// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/view_index.h"

#include <cmath>
#include <cstddef>

#include "base/angles.h"
#include "edge_sketch/evidence.h"
#include "geometry/image_edge.h"

namespace curvix {
namespace {

double AngleOf(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

}  // namespace

const Edge2d& EdgeOf(const EdgeRef& ref, const std::vector<ViewIndex>& views) {
  const EdgeMap& map = *views[static_cast<std::size_t>(ref.view_idx)].edges;
  return map.edges[static_cast<std::size_t>(ref.edge_idx)];
}

PlaneMeasurement MeasurePlane(const EdgeRef& ref,
                              const std::vector<ViewIndex>& views) {
  return MeasurePlane(*views[static_cast<std::size_t>(ref.view_idx)].view,
                      ToImageEdge(EdgeOf(ref, views)));
}

double VoteWithSupport(const ViewIndex& view,
                       const ImageEdge& projected,
                       double expected_px,
                       const ImageEdge& support) {
  const Eigen::Vector2d normal(-support.tangent.y(), support.tangent.x());
  const double angle = AngleOf(projected.tangent);
  const SupportFit fit{normal.dot(projected.position - support.position),
                       expected_px,
                       UndirectedDifference(angle, AngleOf(support.tangent))};
  return VoteWithSupport(fit, view.density.Density(projected.position, angle));
}

}  // namespace curvix
