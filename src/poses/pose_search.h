// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Steps of the refinement of poses and cameras; see
// docs/stages/poses.md.
#pragma once

#include <curvix/options.h>
#include <curvix/reconstruct.h>
#include <curvix/scene.h>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "poses/adjust_poses.h"
#include "poses/pose_observation_set.h"
#include "poses/posed_edges.h"

namespace curvix {

class PoseSearch {
 public:
  // The arguments must outlive it. `step_done` is called between steps; it
  // returns false to stop.
  PoseSearch(const Scene& scene,
             const std::vector<EdgeMap>& edge_maps,
             const Options& options,
             StepDone step_done);

  // What the steps change.
  struct State {
    MovedCameras moved;
    std::vector<double> sigmas_px;  // by view, of edges about projections
    double prior_px = 0;
    std::vector<bool> free_lenses;
    std::size_t min_supports = 0;  // of the last sketch
  };
  State state() const;
  void SetState(const State& state);

  // The present poses and cameras, and the edges of the views.
  const PosedEdges& edges() const { return edges_; }
  void Move(const MovedCameras& moved) { edges_.Move(moved); }
  bool is_stopped() const { return is_stopped_; }

  // By camera: whether it is refined. At first none is.
  const std::vector<bool>& free_lenses() const { return free_lenses_; }
  void FreeLenses(std::vector<bool> is_free) {
    free_lenses_ = std::move(is_free);
  }

  // Places on curves. If there are few, edges are searched further away.
  std::vector<CurvePlace> Sketch();

  // Rotates each camera so that its image shifts by what most places agree on.
  // Whether any camera rotated.
  bool ShiftViews(const std::vector<CurvePlace>& places);

  // Adjusts poses, free cameras, places and points jointly. Moves the poses and
  // cameras only, and returns all.
  AdjustedPoses AdjustCameras(const PoseObservationSet& observations);
  // The same, but moves places and points, too.
  void Adjust(PoseObservationSet* observations);

  // Alternates FindEdges() and Adjust() until edges come no nearer.
  void AdjustInTurns(PoseObservationSet* observations);

  // Matches places with edges again; drops places with few.
  void FindEdges(std::vector<CurvePlace>* places) const;

  // Fits places and points to the present poses and cameras.
  void Fit(PoseObservationSet* observations) const;

  // The loss of each place, then of each point, after an adjustment of poses to
  // `observations` alone with fixed cameras. The state does not change.
  std::vector<double> LossesOf(const PoseObservationSet& observations);

  // Restores the gauge: scale and frame that places and points have with the
  // poses of the scene. Views that see none of them stay.
  void RestoreGauge(PoseObservationSet* observations);

  // How far each image has shifted since `before`: the median over the places
  // and points of `observations` in the view; nothing where these are too few.
  std::vector<std::optional<double>> Shifts(
      const PoseObservationSet& observations, const MovedCameras& before) const;
  // Median over the views.
  double MedianShift(const PoseObservationSet& observations,
                     const MovedCameras& before) const;

 private:
  std::vector<std::vector<double>> DistancesByView(
      const std::vector<CurvePlace>& places) const;
  void UpdateSigmas(const std::vector<CurvePlace>& places);
  double PriorFor(const PoseObservationSet& observations) const;
  AdjustedPoses Solve(const PoseObservationSet& observations,
                      double prior_px,
                      const std::vector<bool>& free_lenses);

  const Scene& scene_;
  const double edge_sigma_px_;
  const StepDone step_done_;
  // Of a pixel of a point, in x and in y, by the poses of the scene.
  const double point_sigma_px_;
  PosedEdges edges_;
  std::vector<double> sigmas_px_;
  double prior_px_;
  std::vector<bool> free_lenses_;
  std::size_t min_supports_ = 0;
  bool is_stopped_ = false;
};

}  // namespace curvix
