// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Steps of the refinement of poses and cameras; see
// docs/stages/poses.md.
#pragma once

#include <curvix/options.h>
#include <curvix/reconstruct.h>
#include <curvix/scene.h>
#include <optional>
#include <utility>
#include <vector>

#include "poses/pose_observation_set.h"
#include "poses/posed_edges.h"

namespace curvix {

class PoseSearch {
 public:
  // Enough if edges are found anew afterwards.
  static constexpr double kRoughGain = 3e-3;
  static constexpr double kFineGain = 1e-4;

  // The arguments must outlive it. `step_done` is called now and then; false:
  // stop.
  PoseSearch(const Scene& scene,
             const std::vector<EdgeMap>& edge_maps,
             const Options& options,
             StepDone step_done);

  // Poses and cameras as they are, and what views see with them.
  const PosedEdges& edges() const { return edges_; }
  void Move(const MovedCameras& moved) { edges_.Move(moved); }
  bool is_stopped() const { return is_stopped_; }

  // By camera: whether it is refined, too. None to begin with.
  const std::vector<bool>& free_lenses() const { return free_lenses_; }
  void FreeLenses(std::vector<bool> is_free) {
    free_lenses_ = std::move(is_free);
  }

  // Places on curves; if they are few, edges are expected farther off.
  std::vector<CurvePlace> Sketch();

  // Turns each camera such that its picture shifts to where most places agree.
  // Whether any did.
  bool ShiftViews(const std::vector<CurvePlace>& places);

  // Adjusts poses, cameras that are free, places and points to each other,
  // until a step gains less than a share of the loss.
  void Adjust(PoseObservationSet* evidence, double min_gain = kRoughGain);

  // Finds edges and adjusts in turns, until edges come no nearer.
  void AdjustInTurns(PoseObservationSet* evidence);

  // Finds the edges of the places anew; drops places with few.
  void FindEdges(std::vector<CurvePlace>* places) const;

  // Fits places and points to poses and cameras as they are.
  void Fit(PoseObservationSet* evidence) const;

  // The loss of each place, then of each point, once poses are adjusted to
  // `evidence` alone and cameras stay. Nothing moves.
  std::vector<double> LossesOf(const PoseObservationSet& evidence);

  // Brings the world back to the unit that places and points have by the poses
  // of the scene, and to where these show it.
  void HoldTheWorld(PoseObservationSet* evidence);

  // How far pictures have shifted since `before`, by view: the median over what
  // the view shows of `evidence`; nothing in views that show too little of it.
  std::vector<std::optional<double>> Shifts(const PoseObservationSet& evidence,
                                            const MovedCameras& before) const;
  // Of the typical view.
  double MedianShift(const PoseObservationSet& evidence,
                     const MovedCameras& before) const;

 private:
  // The position fitted to poses and cameras as they are.
  Eigen::Vector3d Fitted(const PointSample& point) const;
  std::vector<std::vector<double>> DistancesByView(
      const std::vector<CurvePlace>& places) const;
  void UpdateSigmas(const std::vector<CurvePlace>& places);
  double PriorFor(const PoseObservationSet& evidence) const;
  AdjustedPoses Solve(const PoseObservationSet& evidence,
                      double prior_px,
                      const std::vector<bool>& free_lenses,
                      double min_gain);
  std::vector<Eigen::Vector3d> PositionsByInput(
      const PoseObservationSet& evidence);
  void RestoreScale(PoseObservationSet* evidence);

  const Scene& scene_;
  const int num_threads_;
  const double edge_sigma_px_;
  const StepDone step_done_;
  // Of a pixel of a point, in x and in y, by the poses of the scene.
  const double point_sigma_px_;
  PosedEdges edges_;
  std::vector<double> sigmas_px_;  // by view, of edges about projections
  double prior_px_;
  std::vector<bool> free_lenses_;
  bool is_stopped_ = false;
};

}  // namespace curvix
