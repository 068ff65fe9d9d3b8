// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3 ("overlapping views").
#include "hypotheses/view_overlap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/median.h"
#include "geometry/epipolar.h"

namespace curvix {
namespace {

constexpr std::size_t kMinNumPoints = 8;
constexpr std::size_t kMaxNumPlaces = 64;
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

double WorkingDepth(const std::vector<PosedView>& views, std::size_t view_idx) {
  std::vector<double> depths, distances;
  for (std::size_t j = 0; j < views.size(); ++j) {
    if (j == view_idx || ShareCenter(views[view_idx], views[j])) continue;
    if (const auto depth = DepthNearestTo(views[view_idx], views[j])) {
      depths.push_back(*depth);
    }
    distances.push_back((views[j].center - views[view_idx].center).norm());
  }
  if (!depths.empty()) return Median(depths);
  // Parallel cameras: an object some baselines away, as in a row of
  // photographs.
  std::sort(distances.begin(), distances.end());
  return distances.empty() ? 1 : 5 * distances.front();
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
  if (ShareCenter(view, other)) return std::nullopt;
  std::vector<double> angles;
  for (const Eigen::Vector3d& place : places) {
    const Eigen::Vector3d x = other.InCamera(place);
    if (!(x.z() > 0) || !other.Contains(other.Pixel(x))) continue;
    const Eigen::Vector3d ray1 = place - view.center;
    const Eigen::Vector3d ray2 = place - other.center;
    angles.push_back(std::atan2(ray1.cross(ray2).norm(), ray1.dot(ray2)));
  }
  if (angles.empty()) return std::nullopt;
  const Eigen::Vector3d baseline = (other.center - view.center).normalized();
  const Eigen::Vector3d axis = OpticalAxis(view);
  const Eigen::Vector3d across = baseline - axis * axis.dot(baseline);
  ViewOverlap overlap;
  overlap.share =
      static_cast<double>(angles.size()) / static_cast<double>(places.size());
  overlap.ray_angle_rad = Median(std::move(angles));
  if (across.norm() > kMinAcross) overlap.baseline_across = across.normalized();
  return overlap;
}

}  // namespace

std::vector<std::vector<Eigen::Vector3d>> FindPlaces(
    const std::vector<PosedView>& views,
    const std::vector<ScenePoint>& points) {
  std::vector<std::vector<Eigen::Vector3d>> places(views.size());
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

std::vector<std::vector<ViewOverlap>> FindOverlaps(
    const std::vector<PosedView>& views,
    const std::vector<ScenePoint>& points) {
  const auto places = FindPlaces(views, points);
  std::vector<std::vector<ViewOverlap>> overlaps(views.size());
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

}  // namespace curvix
