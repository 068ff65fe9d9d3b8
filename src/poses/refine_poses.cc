// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What is refined, in which order, and what of it is
// accepted; see docs/stages/poses.md.
#include <curvix/refine_poses.h>
#include <algorithm>
#include <utility>

#include "base/cancelled.h"
#include "base/median.h"
#include "base/option_table.h"
#include "base/parallel.h"
#include "base/text_fields.h"
#include "geometry/lens.h"
#include "model/check_input.h"
#include "pipeline/run_recorder.h"
#include "poses/held_out.h"
#include "poses/pose_search.h"
#include "poses/posed_edges.h"

namespace curvix {
namespace {

constexpr double kSmallShiftPx = 0.5;  // asks for no new sketch
// Edges of exact poses are half as far off; poses a quarter of a pixel off make
// it twice as much.
constexpr double kGoodEnoughPx = 0.06;
constexpr double kNothingFitsPx = 1;
constexpr int kNumFinalRounds = 2;
constexpr std::size_t kMinHeldOut = 20;  // places and points
// With fewer views, a lens is hardly distinguishable from poses and structure.
constexpr int kMinViewsPerLens = 5;

ErrorsOfViews Summarize(std::vector<double> errors) {
  ErrorsOfViews summary;
  for (const double error : errors) {
    summary.mean_px += error / static_cast<double>(errors.size());
  }
  summary.median_px = MedianOr(0, std::move(errors));
  return summary;
}

class Refiner {
 public:
  Refiner(const Scene& scene,
          const std::vector<EdgeMap>& edge_maps,
          const Options& options,
          bool refine_intrinsics,
          RunRecorder* run)
      : scene_(scene),
        num_threads_(options.runtime.num_threads),
        search_(scene, edge_maps, options, run->Steps()),
        at_sketch_(search_.edges().moved()) {
    if (refine_intrinsics) shared_lenses_ = SharedLenses();
  }

  CurvePoses Run() {
    Begin();
    if (DoPointsFit()) {
      return AsTheyAre("the points are where the poses put them");
    }
    const bool has_shifted = search_.ShiftViews(observations_.places);
    if (!has_shifted && DoEdgesFit()) {
      return AsTheyAre("the edges are where the poses put them");
    }
    if (!observations_.points.empty()) AdjustToPoints();
    search_.AdjustInTurns(&observations_);
    if (observations_.points.empty() && HasMovedSinceSketch()) {
      SketchAgain();
      search_.ShiftViews(observations_.places);
      search_.AdjustInTurns(&observations_);
    }
    if (TryLenses()) {
      SketchAgain();
      search_.AdjustInTurns(&observations_);
    }
    search_.RestoreGauge(&observations_);
    CurvePoses result = Judge();
    if (result.accepted) Finish(&result);
    return result;
  }

 private:
  // Places and points by the input, and what of them is held out.
  void Begin() {
    ChosenPoints points =
        ChoosePoints(UsablePoints(scene_), scene_.views.size());
    observations_ = {search_.Sketch(), std::move(points.chosen)};
    cells_ = SpaceCells(PositionsOf(observations_));
    held_out_ = {TakeHeldOut(cells_, &observations_.places),
                 std::move(points.held_out)};
    last_held_out_ = held_out_.places;
    before_ = Measure();
  }

  void SketchAgain() {
    observations_.places = search_.Sketch();
    last_held_out_ = TakeHeldOut(cells_, &observations_.places);
    at_sketch_ = search_.edges().moved();
  }

  bool HasMovedSinceSketch() const {
    return search_.MedianShift(observations_, at_sketch_) >= kSmallShiftPx;
  }

  HeldOutErrors Measure() const {
    return MeasureHeldOut(held_out_, num_threads_, search_.edges());
  }

  // Saves the search if there is nothing to find.
  bool DoEdgesFit() const {
    std::vector<double> errors;
    for (const ErrorPair& pair :
         PairErrors(held_out_, before_, before_, search_.edges())) {
      errors.push_back(pair.before);
    }
    return MedianOr(kNothingFitsPx, std::move(errors)) < kGoodEnoughPx;
  }

  // In each view. Then the points contradict any other poses.
  bool DoPointsFit() const {
    std::vector<std::vector<double>> errors(scene_.views.size());
    for (std::size_t i = 0; i < held_out_.points.size(); ++i) {
      const auto& seen = held_out_.points[i].observations;
      for (std::size_t k = 0; k < seen.size(); ++k) {
        errors[static_cast<std::size_t>(seen[k].view_idx)].push_back(
            before_.points[i][k]);
      }
    }
    return std::all_of(errors.begin(), errors.end(), [](auto& of_view) {
      return MedianOr(kNothingFitsPx, std::move(of_view)) < kGoodEnoughPx;
    });
  }

  CurvePoses AsTheyAre(const char* reason) {
    CurvePoses result = Judge();
    result.reason = reason;
    return result;
  }

  // Poses from points alone; then places by these.
  void AdjustToPoints() {
    observations_.places.clear();
    search_.Adjust(&observations_);
    SketchAgain();
  }

  // By camera: whether enough views share it.
  std::vector<bool> SharedLenses() const {
    std::vector<int> counts(scene_.cameras.size(), 0);
    for (const View& view : scene_.views) {
      ++counts[static_cast<std::size_t>(view.camera_idx)];
    }
    std::vector<bool> is_shared;
    for (const int count : counts) {
      is_shared.push_back(count >= kMinViewsPerLens);
    }
    return is_shared;
  }

  // The shared cameras by models with more terms.
  std::vector<Camera> Extended(std::vector<Camera> cameras) const {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      if (shared_lenses_[i]) cameras[i] = WithMoreTerms(cameras[i]);
    }
    return cameras;
  }

  // Refines shared cameras, first by their own terms, then by more. Since all
  // views share these few parameters, two fifths of space determine them; all
  // else is test data. Poses are adjusted to it with the old and with the new
  // cameras, which are kept if that fits better. Whether cameras have changed.
  bool TryLenses() {
    if (std::count(shared_lenses_.begin(), shared_lenses_.end(), true) == 0) {
      return false;
    }
    PoseObservationSet training = observations_;
    PoseObservationSet test =
        HoldOutMore(cells_, {last_held_out_, held_out_.points}, &training);
    const MovedCameras before = search_.edges().moved();
    // The same edges for all, since more edges have a larger loss.
    search_.Fit(&test);
    search_.FindEdges(&test.places);
    std::vector<double> best_losses = search_.LossesOf(test);
    MovedCameras best = before;
    std::vector<Camera> cameras = before.cameras;
    search_.FreeLenses(shared_lenses_);
    while (!search_.is_stopped()) {
      PoseObservationSet adjusted = training;
      search_.Move({before.new_cam_from_cam, cameras});
      search_.Adjust(&adjusted);
      std::vector<double> losses = search_.LossesOf(test);
      if (search_.edges().moved().cameras != before.cameras &&
          IsProven(test, best_losses, losses)) {
        best_losses = std::move(losses);
        best = search_.edges().moved();
      }
      std::vector<Camera> longer = Extended(cameras);
      if (longer == cameras) break;
      cameras = std::move(longer);
    }
    const bool have_changed = best.cameras != before.cameras;
    search_.Move(best);
    if (have_changed) {
      search_.Fit(&observations_);
    } else {
      search_.FreeLenses({});
    }
    return have_changed;
  }

  // Whether the losses of `test` fall, and not by chance.
  bool IsProven(const PoseObservationSet& test,
                const std::vector<double>& before,
                const std::vector<double>& after) const {
    const std::vector<Eigen::Vector3d> positions = PositionsOf(test);
    GainsByCell places(cells_), points(cells_);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      GainsByCell& gains = i < test.places.size() ? places : points;
      gains.Add(positions[i], before[i] - after[i]);
    }
    return IsBetter(Together(places, points));
  }

  // Views in which errors grow keep their poses, unless lenses have changed,
  // for which the old poses do not hold.
  void RestoreWorseViews(const HeldOutErrors& after) {
    if (!search_.free_lenses().empty()) return;
    const std::vector<bool> worse =
        WorseViews(PairErrors(held_out_, before_, after, search_.edges()),
                   scene_.views.size());
    MovedCameras moved = search_.edges().moved();
    for (std::size_t i = 0; i < worse.size(); ++i) {
      if (worse[i]) moved.new_cam_from_cam[i] = Rigid3();
    }
    search_.Move(moved);
  }

  CurvePoses Judge() {
    CurvePoses result;
    result.num_samples = observations_.places.size() + held_out_.places.size();
    result.num_points = observations_.points.size() + held_out_.points.size();
    result.num_check_samples = held_out_.places.size();
    result.num_check_points = held_out_.points.size();
    RestoreWorseViews(Measure());
    const HeldOutErrors after = Measure();
    SummarizeErrors(after, &result);
    Decide(CompareErrors(held_out_, cells_, before_, after, search_.edges()),
           &result);
    PutPoses(held_out_, &result);
    return result;
  }

  void SummarizeErrors(const HeldOutErrors& after, CurvePoses* result) const {
    std::vector<double> from, to;
    for (const ErrorPair& pair :
         PairErrors(held_out_, before_, after, search_.edges())) {
      from.push_back(pair.before);
      to.push_back(pair.after);
    }
    result->num_check_observations = from.size();
    result->before = Summarize(std::move(from));
    result->after = Summarize(std::move(to));
    result->points_before = Summarize(Concatenate(before_.points));
    result->points_after = Summarize(Concatenate(after.points));
  }

  // Cameras that are proven better are enough: the poses of the scene were made
  // for the old ones.
  void Decide(const SignificanceOfGain& gain, CurvePoses* result) const {
    result->significance = gain.all;
    const bool has_new_cameras = !search_.free_lenses().empty();
    result->accepted = has_new_cameras ? IsNoWorse(gain) : IsBetter(gain);
    result->reason = FormatText(
        "what was held out comes nearer by %.1f standard deviations "
        "(edges %.1f, points %.1f)",
        gain.all,
        gain.places,
        gain.points);
    if (!result->accepted) result->reason = "may be chance: " + result->reason;
    if (result->num_check_samples + result->num_check_points < kMinHeldOut) {
      result->accepted = false;
      result->reason = "too little is left to judge by";
    }
  }

  // Adjusts to all observations, held-out ones included; places are those found
  // by the nearly final poses.
  void Finish(CurvePoses* result) {
    held_out_.places = std::move(last_held_out_);
    search_.Fit(&held_out_);
    observations_.places.insert(observations_.places.end(),
                                held_out_.places.begin(),
                                held_out_.places.end());
    observations_.points.insert(observations_.points.end(),
                                held_out_.points.begin(),
                                held_out_.points.end());
    for (int i = 0; i < kNumFinalRounds && !search_.is_stopped(); ++i) {
      search_.FindEdges(&observations_.places);
      const bool is_last = i + 1 == kNumFinalRounds;
      search_.Adjust(&observations_,
                     is_last ? PoseSearch::kFineGain : PoseSearch::kRoughGain);
    }
    search_.RestoreGauge(&observations_);
    PutPoses(observations_, result);
  }

  std::size_t NumViewsMoved() const {
    const MovedCameras& moved = search_.edges().moved();
    std::size_t count = 0;
    for (std::size_t i = 0; i < scene_.views.size(); ++i) {
      const Rigid3& increment = moved.new_cam_from_cam[i];
      const auto k = static_cast<std::size_t>(scene_.views[i].camera_idx);
      const bool stays =
          increment.translation.isZero(0) &&
          increment.rotation.coeffs() == Rigid3().rotation.coeffs() &&
          moved.cameras[k] == scene_.cameras[k];
      if (!stays) ++count;
    }
    return count;
  }

  void PutPoses(const PoseObservationSet& observations,
                CurvePoses* result) const {
    std::vector<double> shifts;
    for (const std::optional<double>& shift :
         search_.Shifts(observations, search_.edges().Unmoved())) {
      shifts.push_back(shift.value_or(0));
    }
    const auto largest = std::max_element(shifts.begin(), shifts.end());
    result->max_shift_px = *largest;
    result->max_shift_view_idx =
        static_cast<std::size_t>(largest - shifts.begin());
    result->num_views_moved = NumViewsMoved();
    result->median_shift_px = MedianOr(0, std::move(shifts));
    result->cameras =
        result->accepted ? search_.edges().moved().cameras : scene_.cameras;
    result->cam_from_world.clear();
    for (std::size_t i = 0; i < scene_.views.size(); ++i) {
      result->cam_from_world.push_back(result->accepted
                                           ? search_.edges().PoseOf(i)
                                           : scene_.views[i].cam_from_world);
    }
  }

  const Scene& scene_;
  const int num_threads_;
  PoseSearch search_;
  std::vector<bool> shared_lenses_;  // by camera; empty: none is refined
  PoseObservationSet observations_;
  PoseObservationSet held_out_;
  MovedCameras at_sketch_;                 // the last
  std::vector<CurvePlace> last_held_out_;  // of that sketch
  SpaceCells cells_{{}};
  HeldOutErrors before_;
};

}  // namespace

Result<CurvePoses> RefinePosesWithCurves(const Scene& scene,
                                         const std::vector<EdgeMap>& edge_maps,
                                         const Options& options,
                                         const Progress& progress,
                                         bool refine_intrinsics) {
  if (Status status = CheckScene(scene); !status.ok()) return status;
  if (Status status = CheckEdgeMaps(scene, edge_maps); !status.ok()) {
    return status;
  }
  if (Status status = Validate(options); !status.ok()) return status;
  RunRecorder run(progress);
  run.Begin("refine_poses_with_curves");
  const auto refine = [&](bool with_cameras) {
    return Refiner(scene, edge_maps, options, with_cameras, &run).Run();
  };
  CurvePoses result = refine(refine_intrinsics);
  // Later steps need the edges of the new cameras.
  if (const Status status = CanCarryEdges(scene, edge_maps, result.cameras);
      !status.ok()) {
    result = refine(false);
    result.reason += "; cameras stay: " + status.message();
  }
  if (run.cancelled()) return CancelledStatus();
  return result;
}

}  // namespace curvix
