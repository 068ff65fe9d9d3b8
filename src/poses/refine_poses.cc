// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What is refined, in which order, and what of it is
// accepted; see docs/stages/poses.md.
#include <curvix/refine_poses.h>
#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
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
constexpr int kNumFinalRounds = 2;
constexpr std::size_t kMinHeldOut = 20;  // places and points

ErrorsOfViews Summarize(const std::vector<double>& errors) {
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  const auto num = static_cast<double>(std::max<std::size_t>(1, errors.size()));
  return {.mean_px = sum / num, .median_px = MedianOr(0, errors)};
}

// The free cameras by models with more terms.
std::vector<Camera> Extended(std::vector<Camera> cameras,
                             const std::vector<bool>& free_lenses) {
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (free_lenses[i]) cameras[i] = WithMoreTerms(cameras[i]);
  }
  return cameras;
}

// Searches for better poses without the set of cells that is held out.
class Refiner {
 public:
  // `search` has the poses and cameras of the scene; `places` are its sketch.
  // The search and the scene must outlive this.
  Refiner(const Scene& scene,
          std::vector<CurvePlace> places,
          bool refine_intrinsics,
          PoseSearch* search)
      : scene_(scene),
        refine_intrinsics_(refine_intrinsics),
        search_(*search),
        observations_{std::move(places), {}},
        at_sketch_(search_.edges().moved()) {}

  // `cells`: of an earlier search; nullopt: those of the places and points.
  void Search(int held_out_set, const std::optional<SpaceCells>& cells) {
    Begin(held_out_set, cells);
    if (PointsFit(held_out_, before_, scene_.views.size())) {
      reason_to_stay_ = "the points are where the poses put them";
    } else if (held_out_.places.size() + held_out_.points.size() <
               kMinHeldOut) {
      reason_to_stay_ = "too little is left to judge by";
    } else if (!search_.ShiftViews(observations_.places) && EdgesFit(before_)) {
      reason_to_stay_ = "the edges are where the poses put them";
    } else {
      Improve();
    }
    after_ = Measure();
    // Before views are restored, which are chosen by the same errors.
    gains_ = CompareErrors(held_out_, cells_, before_, after_);
  }

  const SpaceCells& cells() const { return cells_; }
  const HeldOutGains& gains() const { return *gains_; }

  // Adds those of another search, in which other cells were held out.
  void Add(const HeldOutGains& gains) {
    gains_->places.Add(gains.places);
    gains_->points.Add(gains.points);
  }

  // Whether `num_searches` leave open if the poses are better.
  bool IsOpen(int num_searches) const {
    return reason_to_stay_.empty() && !IsAccepted() &&
           MayBecomeBetter(Together(*gains_), num_searches) &&
           !search_.is_stopped();
  }

  CurvePoses Finish() {
    FindWorseViews();
    if (RestoreWorseViews()) after_ = Measure();
    CurvePoses result = Judge();
    if (result.accepted) AdjustToAll(&result);
    return result;
  }

 private:
  void Improve() {
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
  }

  // Places and points by the input, and what of them is held out.
  void Begin(int held_out_set, const std::optional<SpaceCells>& cells) {
    ChosenPoints points =
        ChoosePoints(UsablePoints(scene_), scene_.views.size(), held_out_set);
    observations_.points = std::move(points.chosen);
    cells_ = cells.value_or(SpaceCells(PositionsOf(observations_)))
                 .StartingWith(held_out_set);
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
    return MeasureHeldOut(held_out_, search_.edges());
  }

  // Poses from points alone; then places by these.
  void AdjustToPoints() {
    observations_.places.clear();
    search_.Adjust(&observations_);
    SketchAgain();
  }

  // Refines cameras, first by their own terms, then by more. Two fifths of
  // space determine them; all else is test data. Poses are adjusted to it with
  // the old and with the new cameras, which are kept if that is proven to fit
  // better. Once the input's are given up, one standard error decides between
  // models. Whether cameras have changed: not if they would bend the scene.
  bool TryLenses() {
    if (!refine_intrinsics_) return false;
    PoseObservationSet training = observations_;
    PoseObservationSet test =
        HoldOutMore(cells_, {last_held_out_, held_out_.points}, &training);
    const std::vector<bool> free_lenses =
        LensesToFree(training, {&observations_, &held_out_}, scene_);
    if (std::ranges::find(free_lenses, true) == free_lenses.end()) return false;
    const MovedCameras before = search_.edges().moved();
    // The same edges for all, since more edges have a larger loss.
    search_.Fit(&test);
    search_.FindEdges(&test.places);
    std::vector<double> best_losses = search_.LossesOf(test);
    MovedCameras best = before;
    std::vector<Camera> cameras = before.cameras;
    search_.FreeLenses(free_lenses);
    while (!search_.is_stopped()) {
      search_.Move({before.new_cam_from_cam, cameras});
      search_.AdjustCameras(training);
      std::vector<double> losses = search_.LossesOf(test);
      const SignificanceOfGain gain =
          Together(CompareLosses(test, cells_, best_losses, losses));
      const double least = best.cameras == before.cameras ? kSignificant : 1;
      if (IsBetter(gain, least) &&
          search_.edges().moved().cameras != before.cameras) {
        best_losses = std::move(losses);
        best = search_.edges().moved();
      }
      std::vector<Camera> longer = Extended(cameras, free_lenses);
      if (longer == cameras) break;
      cameras = std::move(longer);
    }
    if (best.cameras == before.cameras || BendsScene(before, best)) {
      search_.Move(before);
      search_.FreeLenses({});
      return false;
    }
    search_.Move(best);
    search_.Fit(&observations_);
    return true;
  }

  // Whether new cameras shift the image too far for the fall of the errors. Not
  // without points. May move the search to `after`.
  bool BendsScene(const MovedCameras& before, const MovedCameras& after) {
    if (observations_.points.empty()) return false;
    std::vector<double> shifts_px;
    for (std::size_t i = 0; i < before.cameras.size(); ++i) {
      if (after.cameras[i] == before.cameras[i]) continue;
      shifts_px.push_back(ShiftOfImage(before.cameras[i], after.cameras[i]));
    }
    const double shift_px = Median(std::move(shifts_px));
    if (!IsShiftTooLarge(shift_px, 0)) return false;
    search_.Move(after);
    const double fall_px = FallOfErrors(before_, Measure());
    if (!IsShiftTooLarge(shift_px, fall_px)) return false;
    reason_of_cameras_ = "; cameras stay: others would shift images by " +
                         FixedText(shift_px, 2) +
                         " px for errors that fall by " +
                         FixedText(fall_px, 2) + " px";
    return true;
  }

  // Views in which errors grow keep their poses, unless lenses have changed,
  // for which the old poses do not hold.
  void FindWorseViews() {
    if (!search_.free_lenses().empty()) return;
    worse_views_ = WorseViews(PairErrors(before_, after_), scene_.views.size());
  }

  // Whether there are such views.
  bool RestoreWorseViews() {
    if (std::ranges::find(worse_views_, true) == worse_views_.end()) {
      return false;
    }
    MovedCameras moved = search_.edges().moved();
    for (std::size_t i = 0; i < worse_views_.size(); ++i) {
      if (worse_views_[i]) moved.new_cam_from_cam[i] = Rigid3();
    }
    search_.Move(moved);
    return true;
  }

  CurvePoses Judge() {
    CurvePoses result;
    result.num_samples = observations_.places.size() + held_out_.places.size();
    result.num_points = observations_.points.size() + held_out_.points.size();
    result.num_check_samples = held_out_.places.size();
    result.num_check_points = held_out_.points.size();
    SummarizeErrors(&result);
    result.accepted = IsAccepted();
    result.reason = Reason();
    result.significance = Together(*gains_).all;
    PutPoses(held_out_, &result);
    return result;
  }

  void SummarizeErrors(CurvePoses* result) const {
    std::vector<double> from, to;
    for (const ErrorPair& pair : PairErrors(before_, after_)) {
      from.push_back(pair.before);
      to.push_back(pair.after);
    }
    result->num_check_observations = from.size();
    result->before = Summarize(from);
    result->after = Summarize(to);
    result->points_before = Summarize(Concatenate(before_.points));
    result->points_after = Summarize(Concatenate(after_.points));
  }

  // Cameras that are proven better are enough: the poses of the scene were made
  // for the old ones.
  bool IsAccepted() const {
    if (!reason_to_stay_.empty()) return false;
    const SignificanceOfGain gain = Together(*gains_);
    const bool has_new_cameras = !search_.free_lenses().empty();
    return has_new_cameras ? IsNoWorse(gain) : IsBetter(gain);
  }

  std::string Reason() const {
    if (!reason_to_stay_.empty()) return reason_to_stay_;
    const SignificanceOfGain gain = Together(*gains_);
    return std::string(IsAccepted() ? "" : "may be chance: ") +
           "what was held out comes nearer by " + FixedText(gain.all, 1) +
           " standard deviations (edges " + FixedText(gain.places, 1) +
           ", points " + FixedText(gain.points, 1) + ")" + reason_of_cameras_;
  }

  // Adjusts to all observations, held-out ones included; places are those found
  // by the nearly final poses.
  void AdjustToAll(CurvePoses* result) {
    held_out_.places = std::move(last_held_out_);
    search_.Fit(&held_out_);
    std::ranges::copy(held_out_.places,
                      std::back_inserter(observations_.places));
    std::ranges::copy(held_out_.points,
                      std::back_inserter(observations_.points));
    for (int i = 0; i < kNumFinalRounds && !search_.is_stopped(); ++i) {
      search_.FindEdges(&observations_.places);
      search_.Adjust(&observations_);
    }
    search_.RestoreGauge(&observations_);
    RestoreWorseViews();
    PutPoses(observations_, result);
  }

  void PutPoses(const PoseObservationSet& observations,
                CurvePoses* result) const {
    std::vector<double> shifts;
    for (const std::optional<double>& shift :
         search_.Shifts(observations, search_.edges().Unmoved())) {
      shifts.push_back(shift.value_or(0));
    }
    const auto largest = std::ranges::max_element(shifts);
    result->max_shift_px = *largest;
    result->max_shift_view_idx =
        static_cast<std::size_t>(largest - shifts.begin());
    result->num_views_moved = search_.edges().NumMoved();
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
  const bool refine_intrinsics_;
  PoseSearch& search_;
  PoseObservationSet observations_;
  PoseObservationSet held_out_;
  MovedCameras at_sketch_;                 // the last
  std::vector<CurvePlace> last_held_out_;  // of that sketch
  SpaceCells cells_{{}};
  HeldOutErrors before_, after_;
  std::optional<HeldOutGains> gains_;
  std::vector<bool> worse_views_;  // empty: none
  std::string reason_to_stay_;
  std::string reason_of_cameras_;  // to stay, although others fit better
};

// Held out is one set of cells; as long as this leaves open if the poses are
// better, other searches hold out other sets. They refine cameras only if the
// first search has found better ones.
CurvePoses Refine(const Scene& scene,
                  const std::vector<EdgeMap>& edge_maps,
                  const Options& options,
                  bool refine_intrinsics,
                  RunRecorder* run) {
  PoseSearch search(scene, edge_maps, options, run->Steps());
  const std::vector<CurvePlace> places = search.Sketch();
  const PoseSearch::State at_input = search.state();
  Refiner refiner(scene, places, refine_intrinsics, &search);
  refiner.Search(0, std::nullopt);
  const PoseSearch::State found = search.state();
  const bool has_new_cameras = !found.free_lenses.empty();
  for (int set = 1; set < SpaceCells::kNumSets && refiner.IsOpen(set); ++set) {
    search.SetState(at_input);
    Refiner other(scene, places, has_new_cameras, &search);
    other.Search(set, refiner.cells());
    refiner.Add(other.gains());
    search.SetState(found);
  }
  return refiner.Finish();
}

}  // namespace

Result<CurvePoses> RefinePosesWithCurves(const Scene& scene,
                                         const std::vector<EdgeMap>& edge_maps,
                                         const Options& options,
                                         const Progress& progress,
                                         bool refine_intrinsics) {
  CURVIX_RETURN_IF_ERROR(CheckScene(scene));
  CURVIX_RETURN_IF_ERROR(CheckEdgeMaps(scene, edge_maps));
  CURVIX_RETURN_IF_ERROR(Validate(options));
  RunRecorder run(progress);
  if (!run.Begin("refine_poses_with_curves")) return CancelledStatus();
  CurvePoses result =
      Refine(scene, edge_maps, options, refine_intrinsics, &run);
  if (result.cameras != scene.cameras) {
    // Later steps need the edges of the new cameras.
    const Status status =
        EdgesWithCameras(scene, edge_maps, result.cameras).status();
    if (!status.ok()) {
      result = Refine(scene, edge_maps, options, false, &run);
      result.reason += "; cameras stay: " + status.message();
    }
  }
  if (run.cancelled()) return CancelledStatus();
  return result;
}

}  // namespace curvix
