// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/pose_refinement.h"

#include <utility>

#include "base/cancelled.h"
#include "base/text_fields.h"
#include "geometry/similarity.h"
#include "plugin/base/text.h"
#include "plugin/poses/pose_refiners.h"

namespace curvix {
namespace {

constexpr char kStage[] = "refine_poses";

std::vector<Rigid3> Poses(const Bundle& bundle) {
  std::vector<Rigid3> poses;
  for (const BundleView& view : bundle.views) {
    poses.push_back(view.cam_from_world);
  }
  return poses;
}

// Refines `bundle` by the refiner that was asked for, or by what is there.
class Refiner {
 public:
  Refiner(const PoseRefinementSettings& settings,
          const std::filesystem::path& log_path,
          const Progress& progress,
          PoseRefinement* result)
      : settings_(settings),
        log_path_(log_path),
        keep_going_([&progress] { return progress(kStage, 0, 0); }),
        result_(result) {}

  Result<Bundle> Run(const Bundle& bundle) {
    if (settings_.refiner == "ceres") return RunCeres(bundle);
    const Result<std::filesystem::path> program =
        FindColmap(settings_.colmap_path);
    if (program.ok()) return RunColmap(bundle, *program);
    result_->notes.push_back("WARNING: " + program.status().message() +
                             ". Poses are refined with Ceres instead.");
    return RunCeres(bundle);
  }

 private:
  Result<Bundle> RunCeres(const Bundle& bundle) {
    result_->record.refiner = "ceres";
    return RefineWithCeres(bundle, keep_going_);
  }

  Result<Bundle> RunColmap(const Bundle& bundle,
                           const std::filesystem::path& program) {
    const ColmapRun run{program, settings_.refiner_timeout_s, log_path_};
    PoseRefinementRecord& record = result_->record;
    record.refiner = "colmap";
    record.colmap_path = program.string();
    record.colmap_version = "unknown";
    const Result<std::string> version = ColmapVersion(run, keep_going_);
    if (!version.ok()) return version.status();
    record.colmap_version = *version;
    return RefineWithColmap(bundle, run, keep_going_);
  }

  const PoseRefinementSettings& settings_;
  const std::filesystem::path log_path_;
  const KeepGoing keep_going_;
  PoseRefinement* const result_;
};

// Moves the world of `refined` back to that of `input`; false if there is no
// similarity that would.
bool AlignTo(const Bundle& input, Bundle* refined, double* scale_removed) {
  const std::optional<Similarity3> back =
      AlignPoses(Poses(*refined), Poses(input));
  if (!back) return false;
  *scale_removed = 1 / back->scale;
  for (BundleView& view : refined->views) {
    view.cam_from_world = MovePose(*back, view.cam_from_world);
  }
  for (BundlePoint& point : refined->points) {
    point.position = *back * point.position;
  }
  return true;
}

std::string RefinerName(const PoseRefinementRecord& record) {
  if (record.refiner == "ceres") return "Ceres";
  return record.colmap_version == "unknown" ? "COLMAP"
                                            : "COLMAP " + record.colmap_version;
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
  const PoseRefinementRecord& record = result->record;
  const bool has_log =
      record.refiner == "colmap" && std::filesystem::exists(log_path);
  const std::string log =
      has_log ? "; see " + log_path.filename().string() : "";
  Keep(reason + log,
       "WARNING: Poses are used as they are: " + RefinerName(record) +
           " failed: ",
       result);
}

// Tests the aligned `refined`, and copies it to `model` if it is accepted.
void Conclude(const ColmapModel& model,
              const Bundle& input,
              Bundle refined,
              std::vector<BundlePoint> check_points,
              PoseRefinement* result) {
  PoseRefinementRecord& record = result->record;
  const PoseJudgement judgement = JudgePoses(input, refined, check_points);
  record.judgement = judgement;
  record.largest_shift_image = model.images[judgement.max_shift_image_idx].name;
  record.accepted = judgement.accepted;
  if (!judgement.accepted) {
    Keep(judgement.reason,
         "Poses are used as they are, not as refined by " +
             RefinerName(record) + ": ",
         result);
    return;
  }
  record.reason = judgement.reason;
  for (BundlePoint& point : check_points) {
    refined.points.push_back(std::move(point));
  }
  FitPoints(&refined);
  result->model = ModelWithBundle(model, refined);
}

}  // namespace

std::string PoseRefinementText(const PoseRefinementRecord& record) {
  if (!record.judgement) return "kept";
  return RefinerName(record) + ", " +
         GroupDigits(static_cast<std::int64_t>(record.num_views)) + " views, " +
         FormatText("%.3f to %.3f px, shifts up to %.2f px",
                    record.judgement->before.mean_px,
                    record.judgement->after.mean_px,
                    record.judgement->max_shift_px) +
         (record.accepted ? "" : ", refused");
}

FlagSection PoseRefinementFlags(PoseRefinementSettings* settings) {
  return {
      "Poses",
      {ChoiceFlag("refiner",
                  {"colmap", "ceres", "none"},
                  &settings->refiner,
                  "bundle adjustment by COLMAP, Ceres or none (--preset "
                  "paper); used if held-out errors fall"),
       Advanced(PathFlag("colmap_path",
                         &settings->colmap_path,
                         "the program colmap, if not in $COLMAP_EXE_PATH or "
                         "$PATH")),
       RowFlag({.name = "refine_intrinsics",
                .field = &settings->refine_intrinsics,
                .max = 1,
                .help = "refine cameras that five views or more share, if "
                        "held-out errors fall"}),
       Advanced(RowFlag({.name = "refiner_timeout_s",
                         .field = &settings->refiner_timeout_s,
                         .min_is_excluded = true,
                         .unit = "s",
                         .help = "time limit for COLMAP; then poses stay"})),
       RowFlag({.name = "refine_poses_with_curves",
                .field = &settings->refine_poses_with_curves,
                .max = 1,
                .help = "refine poses and curves together, used if held-out "
                        "errors fall (0 with --preset paper)"})}};
}

Result<PoseRefinement> RefinePoses(const ColmapModel& model,
                                   const PoseRefinementSettings& settings,
                                   const std::filesystem::path& log_path,
                                   const Progress& progress) {
  PoseRefinement result;
  PoseRefinementRecord& record = result.record;
  if (settings.refiner == "none") {
    record.reason = "not asked for";
    return result;
  }
  if (!progress(kStage, 0, 0)) return CancelledStatus();
  Bundle input = BundleFromModel(model);
  record.num_views = input.views.size();
  record.num_points = input.points.size();
  if (record.num_points < kMinPointsToRefine || record.num_views < 3) {
    Keep("the model has " +
             GroupDigits(static_cast<std::int64_t>(record.num_points)) +
             " points to refine them with, and at least " +
             std::to_string(kMinPointsToRefine) + " in 3 views are needed",
         "Poses are used as they are: ",
         &result);
    return result;
  }
  std::vector<BundlePoint> check_points = TakeCheckPoints(&input);
  Result<Bundle> refined =
      Refiner(settings, log_path, progress, &result).Run(input);
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
