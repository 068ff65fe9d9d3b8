// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/view_index.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/angles.h"
#include "base/parallel.h"
#include "geometry/detected_edge.h"

namespace curvix {
namespace {

// Sigma of the weights of neighbouring views.
constexpr double kNeighborAngleDeg = 25;
constexpr std::size_t kMaxNumNeighbors = 4;
constexpr double kGridCellPx = 8;
constexpr double kGateSigmas = 4;

// The nearest views in direction, nearest first.
std::vector<ViewOverlap> NearestInDirection(std::vector<ViewOverlap> overlaps) {
  std::ranges::sort(overlaps, {}, [](const ViewOverlap& overlap) {
    return std::pair(overlap.ray_angle_rad, overlap.other);
  });
  overlaps.resize(std::min(overlaps.size(), kMaxNumNeighbors));
  return overlaps;
}

double AngleOf(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

}  // namespace

const Edge2d& EdgeOf(const EdgeRef& ref, const std::vector<ViewIndex>& views) {
  const EdgeMap& map = *views[static_cast<std::size_t>(ref.view_idx)].edges;
  return map.edges[static_cast<std::size_t>(ref.edge_idx)];
}

std::vector<PlaneMeasurement> MeasurePlanes(
    const std::vector<EdgeRef>& support, const std::vector<ViewIndex>& views) {
  std::vector<PlaneMeasurement> measurements;
  measurements.reserve(support.size());
  for (const EdgeRef& ref : support) {
    measurements.push_back(
        MeasurePlane(*views[static_cast<std::size_t>(ref.view_idx)].view,
                     ToImageEdge(EdgeOf(ref, views))));
  }
  return measurements;
}

Gate WidestGate(const ValidationOptions& options) {
  Gate gate{options.max_distance_px};
  gate.min_cosine = std::cos(DegToRad(options.max_angle_deg));
  return gate;
}

Gate NarrowGate(const Gate& widest, double expected_px) {
  Gate gate = widest;
  gate.normal_px = std::min(gate.normal_px, kGateSigmas * expected_px);
  return gate;
}

double VoteWithSupport(const ViewIndex& view,
                       const ImageEdge& projected,
                       double expected_px,
                       const ImageEdge& support) {
  const double angle = AngleOf(projected.tangent);
  const SupportFit fit{
      support.Normal().dot(projected.position - support.position),
      expected_px,
      UndirectedDifference(angle, AngleOf(support.tangent))};
  return VoteWithSupport(fit, view.density.Density(projected.position, angle));
}

std::vector<ViewIndex> IndexViews(const std::vector<PosedView>& views,
                                  const std::vector<EdgeMap>& edge_maps,
                                  int num_threads) {
  std::vector<ViewIndex> indices(views.size());
  ParallelFor(indices.size(), num_threads, [&](std::size_t i) {
    const PosedView& view = views[i];
    const EdgeMap& map = edge_maps[i];
    indices[i] = {&view,
                  &map,
                  GridIndex(map.edges, kGridCellPx),
                  EdgeDensity(map, view.width, view.height, view.margin_px)};
  });
  return indices;
}

void AddPresence(const ValidationOptions& options,
                 int num_threads,
                 std::vector<ViewIndex>& indices) {
  ParallelFor(indices.size(), num_threads, [&](std::size_t i) {
    ViewIndex& index = indices[i];
    index.presence = EdgePresence(index.edges->edges,
                                  index.view->width,
                                  index.view->height,
                                  options.max_distance_px,
                                  Gate().tangential_px,
                                  DegToRad(options.max_angle_deg));
  });
}

NeighborsByView NeighborsInDirection(const Overlaps& overlaps) {
  NeighborsByView neighbors(overlaps.size());
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    for (const ViewOverlap& overlap : NearestInDirection(overlaps[i])) {
      const double r = RadToDeg(overlap.ray_angle_rad) / kNeighborAngleDeg;
      neighbors[i].push_back({overlap.other, std::exp(-0.5 * r * r)});
    }
  }
  return neighbors;
}

}  // namespace curvix
