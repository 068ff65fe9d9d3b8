// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What poses and cameras are refined with: places on
// curves, and points.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "poses/adjust_poses.h"
#include "poses/posed_edges.h"

namespace curvix {

struct PoseObservationSet {
  std::vector<CurvePlace> places;
  std::vector<PointSample> points;
};

// World.
inline Eigen::Vector3d PositionOf(const CurvePlace& place) {
  return MiddleOf(place.contour);
}
inline Eigen::Vector3d PositionOf(const PointSample& point) {
  return point.position;
}

// Of the places, then of the points.
std::vector<Eigen::Vector3d> PositionsOf(
    const PoseObservationSet& observations);

// Calls f(view_idx, position) for each place and point and each of its views.
template <typename F>
void VisitSeen(const PoseObservationSet& observations, const F& f) {
  const auto visit = [&f](const auto& seen, const Eigen::Vector3d& position) {
    for (const auto& at : seen) {
      f(static_cast<std::size_t>(at.view_idx), position);
    }
  };
  for (const CurvePlace& place : observations.places) {
    visit(place.support, PositionOf(place));
  }
  for (const PointSample& point : observations.points) {
    visit(point.observations, point.position);
  }
}

// By camera: whether it has enough observations in `training` to be refined.
// Not if one of its views has none in `all`: its pose would not fit another
// camera.
std::vector<bool> LensesToFree(
    const PoseObservationSet& training,
    const std::vector<const PoseObservationSet*>& all,
    const Scene& scene);

// The points of the scene with known pixels in two views or more; none if they
// are fewer than a hundred.
std::vector<PointSample> UsablePoints(const Scene& scene);

// `chosen`: points with the most views, as many as the views need, without
// every fifth of these, the first after 4 - `held_out_set` others. `held_out`:
// all others. Ties: the order of `points`.
struct ChosenPoints {
  std::vector<PointSample> chosen;
  std::vector<PointSample> held_out;
};
ChosenPoints ChoosePoints(std::vector<PointSample> points,
                          std::size_t num_views,
                          int held_out_set);

// Cubic cells. Their side is a tenth of the median distance of positions from
// their median. Each belongs to one of five sets of equal size; cells that
// share a face belong to different ones.
class SpaceCells {
 public:
  using Cell = std::array<double, 3>;
  static constexpr int kNumSets = 5;

  explicit SpaceCells(const std::vector<Eigen::Vector3d>& positions);
  // The same cells, of which the given set is the first.
  SpaceCells StartingWith(int set) const;
  Cell CellOf(const Eigen::Vector3d& position) const;
  int SetOf(const Eigen::Vector3d& position) const;  // 0 to 4; position: finite

 private:
  int first_set_ = 0;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double size_ = 1;
};

// Moves the places of the first set of cells from `places`; both keep their
// order.
std::vector<CurvePlace> TakeHeldOut(const SpaceCells& cells,
                                    std::vector<CurvePlace>* places);

// Returns `held_out` together with the places and points of the first three
// sets of cells, which are moved from `observations`.
PoseObservationSet HoldOutMore(const SpaceCells& cells,
                               PoseObservationSet held_out,
                               PoseObservationSet* observations);

}  // namespace curvix
