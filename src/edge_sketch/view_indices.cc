// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "edge_sketch/view_indices.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/angles.h"
#include "base/parallel.h"
#include "edge_sketch/track_support.h"

namespace curvix {
namespace {

// Views further apart in direction have no vote on each other.
constexpr double kNeighborAngleDeg = 25;
constexpr std::size_t kMaxNumNeighbors = 4;
constexpr double kGridCellPx = 8;

// The nearest views in direction, nearest first.
std::vector<ViewOverlap> NearestInDirection(std::vector<ViewOverlap> overlaps) {
  std::sort(overlaps.begin(),
            overlaps.end(),
            [](const ViewOverlap& a, const ViewOverlap& b) {
              return std::pair(a.ray_angle_rad, a.other) <
                     std::pair(b.ray_angle_rad, b.other);
            });
  overlaps.resize(std::min(overlaps.size(), kMaxNumNeighbors));
  return overlaps;
}

}  // namespace

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
                  EdgeDensity(map, view.width, view.height)};
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
                                  kMaxSupportSlidePx,
                                  DegToRad(options.max_angle_deg));
  });
}

std::vector<std::vector<ViewNeighbor>> NeighborsInDirection(
    const std::vector<std::vector<ViewOverlap>>& overlaps) {
  std::vector<std::vector<ViewNeighbor>> neighbors(overlaps.size());
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    for (const ViewOverlap& overlap : NearestInDirection(overlaps[i])) {
      const double r = RadToDeg(overlap.ray_angle_rad) / kNeighborAngleDeg;
      neighbors[i].push_back({overlap.other, std::exp(-0.5 * r * r)});
    }
  }
  return neighbors;
}

}  // namespace curvix
