// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/run_steps.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/cancelled.h"
#include "base/count_text.h"
#include "base/file_io.h"
#include "colmap/files.h"
#include "measuring/moved_curves.h"
#include "plugin/export/alignment_file.h"
#include "plugin/export/drawing_files.h"
#include "plugin/export/write_results.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// An output folder in which results would lie among the inputs, project.ini
// over COLMAP's, or would take their place: runs remove sparse/ of older ones.
Status CheckOutputPath(const Workspace& workspace) {
  const fs::path output = fs::weakly_canonical(workspace.output_path);
  for (const fs::path& input :
       {workspace.model_path, workspace.image_path, workspace.mask_path}) {
    if (!input.empty() && IsInside(fs::weakly_canonical(input), output)) {
      return Status::InvalidArgument(
          "The results would be written among the inputs in " +
          output.string() + "; choose another folder with --output_path");
    }
  }
  return {};
}

InputSummary SummarizeInput(const Workspace& workspace,
                            const WorkspaceScene& input) {
  InputSummary summary;
  summary.model_path = fs::absolute(workspace.model_path);
  for (const Camera& camera : input.scene.cameras) {
    summary.camera_models.emplace_back(ModelName(camera.model));
  }
  summary.num_views = static_cast<std::int64_t>(input.scene.views.size());
  summary.num_points = static_cast<std::int64_t>(input.scene.points.size());
  summary.missing_images = input.missing_images;
  summary.notes = workspace.notes;
  summary.notes.insert(
      summary.notes.end(), input.notes.begin(), input.notes.end());
  return summary;
}

// How many primitives of each kind there are.
StageCounts CountFits(const FittedCurves& fitted) {
  std::int64_t lines = 0, arcs = 0, ellipses = 0, splines = 0;
  for (const FittedCurve& curve : fitted.curves) {
    for (const CurveFit& fit : curve.fits) {
      lines += fit.kind == FitKind::kLine;
      arcs += fit.kind == FitKind::kArc;
      ellipses += fit.kind == FitKind::kEllipse;
      splines += fit.kind == FitKind::kSpline;
    }
  }
  return {{"lines", lines},
          {"arcs", arcs},
          {"ellipses", ellipses},
          {"splines", splines},
          {"nodes", static_cast<std::int64_t>(fitted.nodes.size())}};
}

// In the world, if it is known.
Result<std::vector<std::string>> WriteInFrame(const CurveRecord& curves,
                                              const fs::path& folder,
                                              const RunRecord& record) {
  const OutputSettings& output = record.settings.output;
  const int num_threads = record.settings.options.runtime.num_threads;
  if (!record.alignment) {
    return WriteResults(curves, output, num_threads, folder);
  }
  const Similarity3& world_from_model = record.alignment->world_from_model;
  const Scene moved_scene = MoveScene(world_from_model, curves.scene);
  const MovedCurves moved_curves(curves.curves, world_from_model);
  const FittedCurves moved = MoveFits(world_from_model, curves.fitted);
  return WriteResults({moved_scene, moved_curves, moved, &*record.alignment},
                      output,
                      num_threads,
                      folder);
}

// Of cameras in the frame of the results, in 32 bits.
bool LosesDigits(const Scene& scene,
                 const std::optional<WorldAlignment>& alignment) {
  constexpr double kLargeCoordinate = 1e5;
  return std::ranges::any_of(scene.views, [&](const View& view) {
    const Eigen::Vector3d center = view.cam_from_world.Inverse().translation;
    const Eigen::Vector3d world =
        alignment ? alignment->world_from_model * center : center;
    return world.cwiseAbs().maxCoeff() > kLargeCoordinate;
  });
}

void NoteRemoved(const std::vector<fs::path>& drawings, RunProgress& progress) {
  if (drawings.empty()) return;
  std::string names;
  for (const fs::path& file : drawings) names += " " + file.string();
  progress.Note("Removed, as drawings of the results before:" + names +
                "; 'colmap_curvix draw' draws these results");
}

}  // namespace

Result<Workspace> FindInput(const RunSettings& settings) {
  CURVIX_ASSIGN_OR_RETURN(Workspace workspace, FindWorkspace(settings));
  CURVIX_RETURN_IF_ERROR(CheckOutputLinks(settings, workspace));
  CURVIX_RETURN_IF_ERROR(CheckOutputPath(workspace));
  return workspace;
}

Result<Workspace> FindInputOfResults(RunSettings settings) {
  if (settings.image_path.empty()) {
    CURVIX_ASSIGN_OR_RETURN(const Workspace found,
                            FindModelAndResults(settings));
    settings.image_path =
        ImagesOfEarlierRun(found.output_path, settings.workspace_path);
  }
  return FindInput(settings);
}

Result<WorkspaceScene> ReadRefinedScene(Workspace workspace) {
  const fs::path refined = workspace.output_path / "sparse";
  if (fs::exists(refined)) workspace.model_path = refined;
  return LoadWorkspaceScene(workspace);
}

Result<WorkspaceScene> ReadInput(const Workspace& workspace,
                                 RunProgress& progress,
                                 RunRecord& record) {
  const Stopwatch stopwatch;
  progress.Update("read_model", 0, 0);
  CURVIX_ASSIGN_OR_RETURN(WorkspaceScene input, LoadWorkspaceScene(workspace));
  CURVIX_RETURN_IF_ERROR(CheckOutput(record.settings.output, input.scene));

  CURVIX_ASSIGN_OR_RETURN(record.alignment,
                          ReadAlignment(workspace.output_path, &input.scene));

  RunSettings& settings = record.settings;
  settings.workspace_path = fs::absolute(settings.workspace_path);
  settings.input_path = fs::absolute(workspace.model_path);
  settings.image_path = fs::absolute(workspace.image_path);
  settings.output_path = fs::absolute(workspace.output_path);
  settings.mask_path = workspace.mask_path;
  record.input = SummarizeInput(workspace, input);
  record.result.output_path = workspace.output_path;
  record.stages.push_back(stopwatch.Read(
      "read_model",
      {{"views", record.input.num_views},
       {"missing images",
        static_cast<std::int64_t>(record.input.missing_images.size())},
       {"points", record.input.num_points}}));
  progress.Finish(Plural(record.input.num_views, "view") + ", " +
                  Plural(record.input.num_points, "point"));
  for (const std::string& note : record.input.notes) progress.Note(note);
  if (LosesDigits(input.scene, record.alignment)) {
    progress.Note(
        "Coordinates are large: the 32-bit floats of .ply and .pcd files lose "
        "digits, other formats do not");
  }
  if (record.alignment) {
    progress.Note("The results are in the frame of " +
                  (workspace.output_path / kAlignmentName).string());
  }
  return input;
}

FittedCurves FitCurvesOf(const Scene& scene,
                         const CurveSource& curves,
                         RunRecord& record) {
  const Stopwatch stopwatch;
  const Options& options = record.settings.options;
  FittedCurves fitted = FitCurves(
      curves, scene, options.curve_fitting, options.runtime.num_threads);
  record.stages.push_back(stopwatch.Read("fit_curves", CountFits(fitted)));
  return fitted;
}

Result<StagedOutput> CreateOutput(const Workspace& workspace) {
  CURVIX_ASSIGN_OR_RETURN(StagedOutput output,
                          StagedOutput::Create(workspace.output_path));
  const std::vector<fs::path> replaced =
      FilesOfEarlierRun(output.output_path());
  for (const char* name : {kModelFolder, kCurvesModelFolder, kOverlaysFolder}) {
    const fs::path folder = (output.output_path() / name).parent_path();
    std::error_code ignored;
    if (EntriesOf(folder).empty() || fs::is_symlink(folder, ignored) ||
        std::ranges::find(replaced, name) != replaced.end()) {
      continue;
    }
    return Status::InvalidArgument(
        "Results would replace " + folder.string() +
        ", which no earlier run wrote; remove it, or choose another folder "
        "with --output_path");
  }
  return output;
}

Result<FittedCurves> WriteFindings(const Scene& scene,
                                   const Findings& findings,
                                   const fs::path& folder,
                                   RunRecord& record) {
  ResultSummary& result = record.result;
  findings.curves.ForEach(
      [&](std::size_t, const Curve& curve) { Count(curve, result); });
  if (record.alignment) {
    result.total_length *= record.alignment->world_from_model.scale;
  }
  result.num_edges_3d = findings.num_edges_3d;
  result.why_empty = findings.why_empty;
  FittedCurves fitted;
  if (result.num_curves > 0) {
    fitted = FitCurvesOf(scene, findings.curves, record);
  }
  CURVIX_RETURN_IF_ERROR(findings.curves.status());
  const Stopwatch stopwatch;
  if (result.num_curves > 0) {
    CURVIX_ASSIGN_OR_RETURN(
        const std::vector<std::string> written,
        WriteInFrame({scene, findings.curves, fitted}, folder, record));
    result.files.insert(result.files.end(), written.begin(), written.end());
  }
  if (findings.is_repeatable) {
    result.files.push_back("project.ini");
    CURVIX_RETURN_IF_ERROR(WriteFileAtomically(folder / "project.ini",
                                               ProjectFile(record.settings)));
  }
  if (result.num_edges_3d > 0) {
    result.files.push_back("edges.ply");
    CURVIX_RETURN_IF_ERROR(findings.write_edges(folder / "edges.ply"));
  }
  record.stages.push_back(stopwatch.Read("write_files"));
  return fitted;
}

Status FinishRun(const Stopwatch& since_start,
                 StagedOutput& output,
                 RunProgress& progress,
                 RunRecord& record) {
  record.result.files.push_back("report.json");
  record.total = since_start.Read("total");
  progress.Finish("");
  CURVIX_RETURN_IF_ERROR(
      WriteFileAtomically(output.folder() / "report.json", ReportJson(record)));
  if (progress.IsCancelled()) return CancelledStatus();
  std::vector<fs::path> obsolete = FilesOfEarlierRun(output.output_path());
  const auto drawings = FilesOfDrawings(output.output_path());
  obsolete.insert(obsolete.end(), drawings.begin(), drawings.end());
  CURVIX_RETURN_IF_ERROR(output.Publish(obsolete));
  NoteRemoved(drawings, progress);
  return {};
}

}  // namespace curvix
