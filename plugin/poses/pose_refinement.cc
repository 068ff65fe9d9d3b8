// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/pose_refinement.h"

#include <utility>

#include "base/cancelled.h"
#include "base/count_text.h"
#include "base/text_fields.h"
#include "geometry/similarity.h"
#include "measuring/moved_curves.h"
#include "plugin/poses/adjustable_scene.h"
#include "plugin/poses/colmap_bundle_adjuster.h"

namespace curvix {
namespace {

constexpr char kStage[] = "refine_poses";
constexpr char kLeftOut[] = "Bundle adjustment is left out: ";

std::vector<Rigid3> Poses(const Scene& scene) {
  std::vector<Rigid3> poses;
  for (const View& view : scene.views) {
    poses.push_back(view.cam_from_world);
  }
  return poses;
}

// `scene` adjusted by COLMAP.
Result<Scene> RunColmap(Scene scene,
                        const ColmapRun& run,
                        const Progress& progress,
                        const AdjustmentCache& cache,
                        PoseRefinementRecord* record) {
  const KeepGoing keep_going = [&] { return progress(kStage, 0, 0); };
  record->refiner = "colmap";
  record->colmap_path = run.program.string();
  record->colmap_version = "unknown";
  const auto adjust = [&] {
    return RefineWithColmap(scene, run, keep_going, &record->colmap_version);
  };
  CURVIX_ASSIGN_OR_RETURN(const BundleAdjustment adjusted,
                          cache ? cache(scene, run.program, adjust) : adjust());
  record->colmap_version = adjusted.program_version;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    scene.views[i].cam_from_world = adjusted.cam_from_world[i];
  }
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    scene.points[i].position = adjusted.positions[i];
  }
  return scene;
}

// Moves the world of `refined` back to that of `input`; false if there is no
// similarity that would.
bool AlignTo(const Scene& input, Scene* refined, double* scale_removed) {
  const std::optional<Similarity3> back =
      AlignPoses(Poses(*refined), Poses(input));
  if (!back) return false;
  *scale_removed = 1 / back->scale;
  *refined = MoveScene(*back, std::move(*refined));
  return true;
}

std::string RefinerName(const PoseRefinementRecord& record) {
  return record.colmap_version == "unknown" ? "COLMAP"
                                            : "COLMAP " + record.colmap_version;
}

std::string TooFewPoints(const ColmapModel& model, const Scene& usable) {
  return "of the model's " + Plural(model.points.size(), "point") + ", " +
         GroupDigits(usable.points.size()) + " can be used (in front of " +
         "their cameras, in images with at least " +
         std::to_string(kMinObservationsPerView) + " of them), and at least " +
         std::to_string(kMinPointsToRefine) + " in 3 views are needed";
}

// The input poses stay, for `reason`.
void Keep(const std::string& reason,
          const std::string& sentence,
          PoseRefinement* result) {
  result->record.reason = reason;
  result->notes.push_back(sentence + reason + ".");
}

void KeepAfterFailure(const std::string& reason,
                      const std::filesystem::path& log_path,
                      PoseRefinement* result) {
  const std::string log = std::filesystem::exists(log_path)
                              ? "; see " + log_path.filename().string()
                              : "";
  Keep(reason + log,
       std::string("WARNING: ") + kLeftOut + RefinerName(result->record) +
           " failed: ",
       result);
}

// The input poses stay, since there is no COLMAP: `reason` says so.
void KeepWithoutColmap(const std::string& reason,
                       bool refine_poses_with_curves,
                       PoseRefinement* result) {
  Keep(reason, std::string("WARNING: ") + kLeftOut, result);
  result->notes.back() +=
      refine_poses_with_curves
          ? " Poses are still refined, with points and curves together "
            "(--refine_poses_with_curves)."
          : " Poses are used as they are.";
}

// Tests the aligned `refined`, and copies it to `model` if it is accepted.
void Conclude(const ColmapModel& model,
              const Scene& input,
              Scene refined,
              std::vector<ScenePoint> check_points,
              PoseRefinement* result) {
  PoseRefinementRecord& record = result->record;
  const PoseJudgement judgement = JudgePoses(input, refined, check_points);
  record.judgement = judgement;
  record.largest_shift_image = input.views[judgement.max_shift_view_idx].name;
  record.accepted = judgement.accepted;
  if (!judgement.accepted) {
    Keep(judgement.reason,
         "Bundle adjustment by " + RefinerName(record) + " is refused: ",
         result);
    return;
  }
  record.reason = judgement.reason;
  for (ScenePoint& point : check_points) {
    refined.points.push_back(std::move(point));
  }
  FitPoints(&refined);
  result->model = ModelWithScene(model, refined);
}

}  // namespace

std::string PoseRefinementText(const PoseRefinementRecord& record) {
  if (!record.judgement) return "kept";
  return RefinerName(record) + ", " + Plural(record.num_views, "view") + ", " +
         FixedText(record.judgement->before.mean_px, 3) + " to " +
         FixedText(record.judgement->after.mean_px, 3) + " px, shifts up to " +
         FixedText(record.judgement->max_shift_px, 2) + " px" +
         (record.accepted ? "" : ", refused");
}

FlagSection PoseRefinementFlags(PoseRefinementSettings* settings) {
  return {
      "Poses",
      {ChoiceFlag("refiner",
                  {"colmap", "none"},
                  &settings->refiner,
                  "bundle adjustment by COLMAP or none (--preset paper); used "
                  "if held-out errors fall"),
       Advanced(PathFlag("colmap_path",
                         &settings->colmap_path,
                         "the program colmap, if not in $COLMAP_EXE_PATH or "
                         "$PATH")),
       RowFlag({.name = "refine_intrinsics",
                .field = &settings->refine_intrinsics,
                .help = "refine cameras, too, if held-out errors fall"}),
       Advanced(RowFlag({.name = "refiner_timeout_s",
                         .field = &settings->refiner_timeout_s,
                         .min_is_excluded = true,
                         .unit = "s",
                         .help = "time limit for COLMAP; then poses stay"})),
       RowFlag({.name = "refine_poses_with_curves",
                .field = &settings->refine_poses_with_curves,
                .help = "refine poses and curves together, used if held-out "
                        "errors fall (0 with --preset paper)"})}};
}

Result<PoseRefinement> RefinePoses(const ColmapModel& model,
                                   const PoseRefinementSettings& settings,
                                   const std::filesystem::path& log_path,
                                   const Progress& progress,
                                   const AdjustmentCache& cache) {
  PoseRefinement result;
  PoseRefinementRecord& record = result.record;
  if (settings.refiner == "none") {
    record.reason = "not asked for";
    return result;
  }
  if (!progress(kStage, 0, 0)) return CancelledStatus();
  Scene input = AdjustableScene(model);
  record.num_views = input.views.size();
  record.num_points = input.points.size();
  if (record.num_points < kMinPointsToRefine || record.num_views < 3) {
    Keep(TooFewPoints(model, input), kLeftOut, &result);
    return result;
  }
  std::vector<ScenePoint> check_points = TakeCheckPoints(&input);
  if (PosesFit(input, check_points)) {
    Keep("the points are where the poses put them", kLeftOut, &result);
    return result;
  }
  const Result<std::filesystem::path> program =
      FindColmap(settings.colmap_path);
  if (!program.ok()) {
    KeepWithoutColmap(
        program.status().message(), settings.refine_poses_with_curves, &result);
    return result;
  }
  Result<Scene> refined =
      RunColmap(input,
                {*program, settings.refiner_timeout_s, log_path},
                progress,
                cache,
                &record);
  if (!refined.ok()) {
    if (refined.status().code() == StatusCode::kCancelled) {
      return refined.status();
    }
    KeepAfterFailure(refined.status().message(), log_path, &result);
    return result;
  }
  if (!AlignTo(input, &*refined, &record.scale_removed)) {
    KeepAfterFailure(
        "its cameras do not resemble the input", log_path, &result);
    return result;
  }
  Conclude(model, input, *std::move(refined), std::move(check_points), &result);
  return result;
}

}  // namespace curvix
