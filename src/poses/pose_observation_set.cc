// SPDX-License-Identifier: BSD-3-Clause
#include "poses/pose_observation_set.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include "base/median.h"

namespace curvix {
namespace {

constexpr std::size_t kMinViewsOfPoint = 2;
constexpr std::size_t kMinPoints = 100;
constexpr int kMaxPointsPerView = 2000;  // for time and memory
constexpr std::size_t kPointsPerHeldOut = 5;
constexpr double kCellsPerDistance = 10;
// Several for each of the at most eight parameters.
constexpr int kMinObservationsPerLens = 50;

std::optional<PointSample> SampleOf(const ScenePoint& point,
                                    const Scene& scene) {
  PointSample sample;
  sample.position = point.position;
  for (std::size_t i = 0; i < point.pixels.size(); ++i) {
    const View& view =
        scene.views[static_cast<std::size_t>(point.view_idxs[i])];
    if (point.pixels[i].allFinite() &&
        Project(CameraOf(scene, view), view.cam_from_world, point.position)) {
      sample.observations.push_back({point.view_idxs[i], point.pixels[i]});
    }
  }
  if (sample.observations.size() < kMinViewsOfPoint) return std::nullopt;
  return sample;
}

// Moves what lies in the first sets of cells to the end of `to`.
template <typename T>
void MoveSets(const SpaceCells& cells,
              int num_sets,
              std::vector<T>* from,
              std::vector<T>* to) {
  const auto moved =
      std::stable_partition(from->begin(), from->end(), [&](const T& value) {
        return cells.SetOf(PositionOf(value)) >= num_sets;
      });
  std::move(moved, from->end(), std::back_inserter(*to));
  from->erase(moved, from->end());
}

}  // namespace

std::vector<bool> LensesToFree(
    const PoseObservationSet& training,
    const std::vector<const PoseObservationSet*>& all,
    const Scene& scene) {
  const auto camera_of = [&](std::size_t view_idx) {
    return static_cast<std::size_t>(scene.views[view_idx].camera_idx);
  };
  std::vector<int> counts(scene.cameras.size(), 0);
  VisitSeen(training, [&](std::size_t i, const Eigen::Vector3d&) {
    ++counts[camera_of(i)];
  });
  std::vector<bool> is_observed(scene.views.size());
  for (const PoseObservationSet* set : all) {
    VisitSeen(*set, [&](std::size_t i, const Eigen::Vector3d&) {
      is_observed[i] = true;
    });
  }
  std::vector<bool> is_free;
  for (const int count : counts) {
    is_free.push_back(count >= kMinObservationsPerLens);
  }
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    if (!is_observed[i]) is_free[camera_of(i)] = false;
  }
  return is_free;
}

std::vector<Eigen::Vector3d> PositionsOf(
    const PoseObservationSet& observations) {
  std::vector<Eigen::Vector3d> positions;
  for (const auto& place : observations.places) {
    positions.push_back(PositionOf(place));
  }
  for (const auto& point : observations.points) {
    positions.push_back(PositionOf(point));
  }
  return positions;
}

std::vector<PointSample> UsablePoints(const Scene& scene) {
  std::vector<PointSample> points;
  for (const ScenePoint& point : scene.points) {
    if (auto sample = SampleOf(point, scene)) {
      points.push_back(*std::move(sample));
    }
  }
  if (points.size() < kMinPoints) points.clear();
  return points;
}

ChosenPoints ChoosePoints(std::vector<PointSample> points,
                          std::size_t num_views,
                          int held_out_set) {
  std::ranges::stable_sort(
      points, std::greater<>(), [](const PointSample& point) {
        return point.observations.size();
      });
  std::vector<int> counts(num_views, 0);
  const auto count_of = [&](const PointSample::Observation& seen) -> int& {
    return counts[static_cast<std::size_t>(seen.view_idx)];
  };
  ChosenPoints result;
  auto num_needed = static_cast<std::size_t>(held_out_set);
  for (PointSample& point : points) {
    const bool is_needed = std::ranges::any_of(
        point.observations,
        [&](const auto& seen) { return count_of(seen) < kMaxPointsPerView; });
    if (!is_needed || ++num_needed % kPointsPerHeldOut == 0) {
      result.held_out.push_back(std::move(point));
      continue;
    }
    for (const auto& seen : point.observations) ++count_of(seen);
    result.chosen.push_back(std::move(point));
  }
  return result;
}

SpaceCells::SpaceCells(const std::vector<Eigen::Vector3d>& positions)
    : center_(MedianPosition(positions)) {
  std::vector<double> distances;
  for (const Eigen::Vector3d& position : positions) {
    distances.push_back((position - center_).norm());
  }
  const double distance = MedianOr(0, std::move(distances));
  if (distance > 0) size_ = distance / kCellsPerDistance;
}

SpaceCells SpaceCells::StartingWith(int set) const {
  SpaceCells cells = *this;
  cells.first_set_ = set;
  return cells;
}

SpaceCells::Cell SpaceCells::CellOf(const Eigen::Vector3d& position) const {
  const Eigen::Array3d cell = ((position - center_) / size_).array().floor();
  return {cell.x(), cell.y(), cell.z()};
}

int SpaceCells::SetOf(const Eigen::Vector3d& position) const {
  const Cell cell = CellOf(position);
  const double rest =
      std::fmod(cell[0] + 2 * cell[1] + 3 * cell[2] - first_set_, kNumSets);
  return static_cast<int>(rest < 0 ? rest + kNumSets : rest);
}

std::vector<CurvePlace> TakeHeldOut(const SpaceCells& cells,
                                    std::vector<CurvePlace>* places) {
  std::vector<CurvePlace> taken;
  MoveSets(cells, 1, places, &taken);
  return taken;
}

PoseObservationSet HoldOutMore(const SpaceCells& cells,
                               PoseObservationSet held_out,
                               PoseObservationSet* observations) {
  MoveSets(cells, 3, &observations->places, &held_out.places);
  MoveSets(cells, 3, &observations->points, &held_out.points);
  return held_out;
}

}  // namespace curvix
