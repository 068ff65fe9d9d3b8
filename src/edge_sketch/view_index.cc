// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/view_index.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/angles.h"
#include "base/infinity.h"
#include "base/parallel.h"
#include "geometry/detected_edge.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

// Sigma of the weights of neighbouring views.
constexpr double kNeighborAngleDeg = 25;
constexpr std::size_t kMaxNumStations = 4;
constexpr double kGridCellPx = 8;
constexpr double kGateSigmas = 4;
constexpr std::ptrdiff_t kNumFinest = 4;
constexpr double kMaxRelativePixelSize = 2;

// The views of the nearest stations in direction, nearest first.
std::vector<ViewOverlap> NearestInDirection(std::vector<ViewOverlap> overlaps,
                                            const std::vector<int>& stations) {
  std::ranges::sort(overlaps, {}, [](const ViewOverlap& overlap) {
    return std::pair(overlap.ray_angle_rad, overlap.other);
  });
  std::vector<int> nearest;
  std::erase_if(overlaps, [&](const ViewOverlap& overlap) {
    const int station = stations[static_cast<std::size_t>(overlap.other)];
    if (std::ranges::find(nearest, station) != nearest.end()) return false;
    if (nearest.size() == kMaxNumStations) return true;
    nearest.push_back(station);
    return false;
  });
  return overlaps;
}

// nullopt outside the image and where it can show no edge or is too coarse.
std::optional<ImageEdge> ProjectWhereSeen(const ViewIndex& index,
                                          const SpaceEdge& edge,
                                          double pixel_size) {
  if (index.edges->edges.empty()) return std::nullopt;
  const auto projected = ProjectInto(*index.view, edge);
  if (!projected || index.edges->unseen.Contain(projected->position) ||
      PixelSizeIn(*index.view, edge.position) >
          kMaxRelativePixelSize * pixel_size) {
    return std::nullopt;
  }
  return projected;
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

Vote VoteWithSupport(const ViewIndex& view,
                     const ImageEdge& projected,
                     double expected_px,
                     const Edge2d& support) {
  const double angle = AngleOf(projected.tangent);
  const SupportFit fit{
      ToBrightSide(support).dot(projected.position - support.position),
      expected_px,
      UndirectedDifference(angle, static_cast<double>(support.angle))};
  Vote vote =
      VoteWithSupport(fit, view.density.Density(projected.position, angle));
  vote.appearance = view.appearance.AppearanceOf(support, projected.tangent);
  return vote;
}

std::vector<ViewIndex> IndexViews(const std::vector<PosedView>& views,
                                  const std::vector<EdgeMap>& edge_maps,
                                  const DistinctViews& distinct,
                                  int num_threads) {
  std::vector<ViewIndex> indices(views.size());
  ParallelFor(indices.size(), num_threads, [&](std::size_t i) {
    const PosedView& view = views[i];
    const EdgeMap& map = edge_maps[i];
    indices[i] = {&view,
                  &map,
                  GridIndex(map.edges, kGridCellPx),
                  EdgeDensity(map, view.width, view.height, view.margin_px),
                  AppearanceDensity(map.edges)};
    indices[i].is_repeated = distinct.are_repeated[i];
    indices[i].before_at_station = distinct.before_at_station[i];
  });
  return indices;
}

double TypicalPixelSize(const Eigen::Vector3d& position,
                        const std::vector<EdgeRef>& support,
                        const std::vector<ViewIndex>& views) {
  if (support.empty()) return kInfinity;
  std::vector<double> sizes;
  sizes.reserve(support.size());
  for (const EdgeRef& ref : support) {
    const ViewIndex& view = views[static_cast<std::size_t>(ref.view_idx)];
    sizes.push_back(PixelSizeIn(*view.view, position));
  }
  const auto nth = sizes.begin() +
                   std::min<std::ptrdiff_t>(kNumFinest, std::ssize(sizes)) - 1;
  std::nth_element(sizes.begin(), nth, sizes.end());
  return *nth;
}

std::optional<ImageEdge> ProjectIntoQueryView(
    std::int32_t view_idx,
    const SpaceEdge& edge,
    double pixel_size,
    const std::vector<ViewIndex>& views) {
  const ViewIndex& index = views[static_cast<std::size_t>(view_idx)];
  if (index.is_repeated) return std::nullopt;
  const auto projected = ProjectWhereSeen(index, edge, pixel_size);
  if (!projected) return std::nullopt;
  for (const int before : index.before_at_station) {
    const ViewIndex& other = views[static_cast<std::size_t>(before)];
    if (ProjectWhereSeen(other, edge, pixel_size)) return std::nullopt;
  }
  return projected;
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

NeighborsByView NeighborsInDirection(const Overlaps& overlaps,
                                     const std::vector<int>& stations) {
  NeighborsByView neighbors(overlaps.size());
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    for (const ViewOverlap& overlap :
         NearestInDirection(overlaps[i], stations)) {
      const double r = RadToDeg(overlap.ray_angle_rad) / kNeighborAngleDeg;
      neighbors[i].push_back({overlap.other, std::exp(-0.5 * r * r)});
    }
  }
  return neighbors;
}

}  // namespace curvix
