// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/view_overlap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/median.h"
#include "geometry/directions.h"
#include "geometry/epipolar.h"

namespace curvix {
namespace {

constexpr std::size_t kMinNumPoints = 8;
constexpr std::size_t kMaxNumPlaces = 64;
constexpr std::size_t kMaxNumCameras = 64;  // that a working depth is from
// Views that see this share of each other's places may repeat each other.
constexpr double kRepeatedShare = 0.9;
// Shares of the baseline below this have no direction.
constexpr double kMinAcross = 1e-6;

Eigen::Vector3d OpticalAxis(const PosedView& view) {
  return view.rotation.row(2).transpose();
}

bool ShareCenter(const PosedView& a, const PosedView& b) {
  return !EpipolarPencil::Make(a, b);
}

// The depth at which the optical axis of `view` passes nearest to that of
// `other`. nullopt for axes less than a degree from parallel, and behind.
std::optional<double> DepthNearestTo(const PosedView& view,
                                     const PosedView& other) {
  const Eigen::Vector3d a = OpticalAxis(view), b = OpticalAxis(other);
  const Eigen::Vector3d baseline = other.center - view.center;
  const double cosine = a.dot(b);
  const double sine2 = 1 - cosine * cosine;
  if (sine2 < 3e-4) return std::nullopt;
  const double depth = (baseline.dot(a) - cosine * baseline.dot(b)) / sine2;
  if (!(depth > 0)) return std::nullopt;
  return depth;
}

// The cameras nearest to one of them, nearest first, without those in its
// place.
std::vector<std::size_t> NearestCameras(const std::vector<PosedView>& views,
                                        std::size_t view_idx) {
  std::vector<std::size_t> near;
  for (std::size_t other = 0; other < views.size(); ++other) {
    if (!ShareCenter(views[view_idx], views[other])) near.push_back(other);
  }
  std::ranges::stable_sort(near, {}, [&](std::size_t other) {
    return (views[other].center - views[view_idx].center).norm();
  });
  near.resize(std::min(near.size(), kMaxNumCameras));
  return near;
}

double WorkingDepth(const std::vector<PosedView>& views, std::size_t view_idx) {
  const std::vector<std::size_t> near = NearestCameras(views, view_idx);
  std::vector<double> depths;
  for (const std::size_t other : near) {
    if (const auto depth = DepthNearestTo(views[view_idx], views[other])) {
      depths.push_back(*depth);
    }
  }
  if (!depths.empty()) return Median(depths);
  // Parallel cameras: an object some baselines away, as in a row of
  // photographs.
  if (near.empty()) return 1;
  return 5 * (views[near.front()].center - views[view_idx].center).norm();
}

std::vector<Eigen::Vector3d> PlacesOnGrid(const PosedView& view, double depth) {
  std::vector<Eigen::Vector3d> places;
  for (const double fy : {0.3, 0.5, 0.7}) {
    for (const double fx : {0.3, 0.5, 0.7}) {
      places.push_back(view.center +
                       depth * view.Ray({fx * view.width, fy * view.height}));
    }
  }
  return places;
}

std::optional<ViewOverlap> Overlap(const PosedView& view,
                                   const std::vector<Eigen::Vector3d>& places,
                                   const PosedView& other) {
  std::vector<double> angles;
  for (const Eigen::Vector3d& place : places) {
    const Eigen::Vector3d x = other.InCamera(place);
    if (!(x.z() > 0) || !other.Contains(other.Pixel(x))) continue;
    angles.push_back(AngleBetween(place - view.center, place - other.center));
  }
  if (angles.empty()) return std::nullopt;
  ViewOverlap overlap;
  overlap.share =
      static_cast<double>(angles.size()) / static_cast<double>(places.size());
  if (ShareCenter(view, other)) return overlap;
  overlap.ray_angle_rad = Median(std::move(angles));
  const Eigen::Vector3d baseline = (other.center - view.center).normalized();
  const Eigen::Vector3d axis = OpticalAxis(view);
  const Eigen::Vector3d across = baseline - axis * axis.dot(baseline);
  if (across.norm() > kMinAcross) overlap.baseline_across = across.normalized();
  return overlap;
}

using Places = std::vector<std::vector<Eigen::Vector3d>>;  // by view

// FindOverlaps() and views with the same centre, whose ray angle is 0.
Overlaps FindAllOverlaps(const std::vector<PosedView>& views,
                         const Places& places) {
  Overlaps overlaps(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t j = 0; j < views.size(); ++j) {
      if (i == j) continue;
      if (auto overlap = Overlap(views[i], places[i], views[j])) {
        overlap->other = static_cast<int>(j);
        overlaps[i].push_back(*overlap);
      }
    }
  }
  return overlaps;
}

void DropNarrow(double max_angle_rad, Overlaps* overlaps) {
  for (std::vector<ViewOverlap>& others : *overlaps) {
    std::erase_if(others, [&](const ViewOverlap& overlap) {
      return overlap.ray_angle_rad <= max_angle_rad;
    });
  }
}

std::vector<std::size_t> ByFallingNumberOfPoints(
    const std::vector<EdgeMap>& edge_maps,
    const std::vector<ScenePoint>& points) {
  std::vector<std::size_t> num_points(edge_maps.size(), 0);
  for (const ScenePoint& point : points) {
    for (const int view_idx : point.view_idxs) {
      ++num_points[static_cast<std::size_t>(view_idx)];
    }
  }
  const auto rank = [&](std::size_t i) {
    return std::pair(num_points[i], edge_maps[i].edges.size());
  };
  std::vector<std::size_t> order(edge_maps.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater<>(), rank);
  return order;
}

std::vector<double> MedianDistances(const std::vector<PosedView>& views,
                                    const Places& places) {
  std::vector<double> medians;
  for (std::size_t i = 0; i < views.size(); ++i) {
    std::vector<double> distances;
    for (const Eigen::Vector3d& place : places[i]) {
      distances.push_back((place - views[i].center).norm());
    }
    medians.push_back(Median(std::move(distances)));
  }
  return medians;
}

// Sets the stations of the views that are not repeated. `order`: of the views.
void FindStations(const std::vector<PosedView>& views,
                  const Places& places,
                  double max_angle_rad,
                  std::vector<std::size_t> order,
                  DistinctViews* distinct) {
  const std::vector<double> distances = MedianDistances(views, places);
  std::erase_if(order,
                [&](std::size_t i) { return distinct->are_repeated[i]; });
  std::vector<bool> has_station(views.size(), false);
  for (const std::size_t first : order) {
    if (has_station[first]) continue;
    std::vector<int> station;
    for (const std::size_t i : order) {
      const double angle_rad = (views[i].center - views[first].center).norm() /
                               std::min(distances[i], distances[first]);
      if (has_station[i] || !(angle_rad < max_angle_rad)) continue;
      has_station[i] = true;
      distinct->stations[i] = static_cast<int>(first);
      distinct->before_at_station[i] = station;
      station.push_back(static_cast<int>(i));
    }
  }
}

bool SeesTheSame(const ViewOverlap& overlap, double min_angle_rad) {
  return overlap.share >= kRepeatedShare &&
         overlap.ray_angle_rad < min_angle_rad;
}

}  // namespace

const ViewOverlap* OverlapWith(const std::vector<ViewOverlap>& overlaps,
                               int other) {
  const auto found =
      std::ranges::lower_bound(overlaps, other, {}, &ViewOverlap::other);
  return found != overlaps.end() && found->other == other ? &*found : nullptr;
}

std::vector<std::vector<Eigen::Vector3d>> FindPlaces(
    const std::vector<PosedView>& views,
    const std::vector<ScenePoint>& points) {
  Places places(views.size());
  for (const ScenePoint& point : points) {
    for (const int view_idx : point.view_idxs) {
      places[static_cast<std::size_t>(view_idx)].push_back(point.position);
    }
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    std::vector<Eigen::Vector3d>& seen = places[i];
    if (seen.size() < kMinNumPoints) {
      seen = PlacesOnGrid(views[i], WorkingDepth(views, i));
    } else if (seen.size() > kMaxNumPlaces) {
      std::vector<Eigen::Vector3d> some;
      for (std::size_t k = 0; k < kMaxNumPlaces; ++k) {
        some.push_back(seen[k * seen.size() / kMaxNumPlaces]);
      }
      seen = std::move(some);
    }
  }
  return places;
}

Overlaps FindOverlaps(const std::vector<PosedView>& views,
                      const std::vector<ScenePoint>& points) {
  Overlaps overlaps = FindAllOverlaps(views, FindPlaces(views, points));
  DropNarrow(0, &overlaps);
  return overlaps;
}

DistinctViews AllDistinct(Overlaps overlaps) {
  DistinctViews distinct;
  distinct.are_repeated.resize(overlaps.size(), false);
  distinct.stations.resize(overlaps.size());
  std::iota(distinct.stations.begin(), distinct.stations.end(), 0);
  distinct.before_at_station.resize(overlaps.size());
  distinct.overlaps = std::move(overlaps);
  return distinct;
}

DistinctViews FindDistinctViews(const std::vector<PosedView>& views,
                                const std::vector<EdgeMap>& edge_maps,
                                const std::vector<ScenePoint>& points,
                                const Options& options) {
  const bool may_repeat =
      options.hypotheses.view_selection == ViewSelection::kEveryView;
  const double min_angle_rad =
      may_repeat ? DegToRad(options.validation.min_view_angle_deg) : 0;
  const Places places = FindPlaces(views, points);
  DistinctViews distinct = AllDistinct(FindAllOverlaps(views, places));
  Overlaps& overlaps = distinct.overlaps;
  std::vector<bool>& are_repeated = distinct.are_repeated;
  const auto order = ByFallingNumberOfPoints(edge_maps, points);
  for (const std::size_t i : order) {
    if (are_repeated[i] || edge_maps[i].edges.empty()) continue;
    for (const ViewOverlap& overlap : overlaps[i]) {
      const auto j = static_cast<std::size_t>(overlap.other);
      const ViewOverlap* back = OverlapWith(overlaps[j], static_cast<int>(i));
      if (SeesTheSame(overlap, min_angle_rad) && back &&
          SeesTheSame(*back, min_angle_rad)) {
        are_repeated[j] = true;
      }
    }
  }
  DropNarrow(min_angle_rad, &overlaps);
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    if (are_repeated[i]) overlaps[i].clear();
    std::erase_if(overlaps[i], [&](const ViewOverlap& overlap) {
      return are_repeated[static_cast<std::size_t>(overlap.other)];
    });
  }
  FindStations(views, places, min_angle_rad, order, &distinct);
  return distinct;
}

namespace {

constexpr std::size_t kMinNumPointsForRange = 16;
constexpr std::size_t kMaxNumWrong = 2;  // on either side
constexpr double kMinRange = 0.2;        // of the median

DepthRange RangeAround(std::vector<double> inverse_depths, double margin) {
  if (inverse_depths.size() < kMinNumPointsForRange) return {};
  std::ranges::sort(inverse_depths);
  const double least = inverse_depths[kMaxNumWrong];
  const double most = inverse_depths[inverse_depths.size() - 1 - kMaxNumWrong];
  const double median = inverse_depths[inverse_depths.size() / 2];
  const double beyond = margin * std::max(most - least, kMinRange * median);
  // 1 / 0 is infinity.
  return {1 / (most + beyond), 1 / std::max(0.0, least - beyond)};
}

}  // namespace

std::vector<DepthRange> FindDepthRanges(const std::vector<PosedView>& views,
                                        const std::vector<ScenePoint>& points,
                                        double margin) {
  std::vector<DepthRange> ranges(views.size());
  if (margin == 0) return ranges;
  std::vector<std::vector<double>> inverse_depths(views.size());
  for (const ScenePoint& point : points) {
    for (const int view_idx : point.view_idxs) {
      const auto i = static_cast<std::size_t>(view_idx);
      const double depth = views[i].InCamera(point.position).z();
      if (depth > 0) inverse_depths[i].push_back(1 / depth);
    }
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    ranges[i] = RangeAround(std::move(inverse_depths[i]), margin);
  }
  return ranges;
}

}  // namespace curvix
