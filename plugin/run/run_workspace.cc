// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/run_workspace.h"

#include <curvix/curve_io.h>
#include <curvix/curves.h>
#include <cstdint>
#include <string>
#include <utility>

#include "base/count_text.h"
#include "base/stopwatch.h"
#include "colmap/colmap_model.h"
#include "edge_detection/load_image.h"
#include "plugin/base/staged_output.h"
#include "plugin/poses/pose_refinement.h"
#include "plugin/run/run_steps.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// What is wrong with the images or masks of a scene, as far as their headers
// tell: at once, where edges would be sought only after minutes.
Status CheckImages(const Scene& scene) {
  for (const View& view : scene.views) {
    CURVIX_RETURN_IF_ERROR(CheckImageAndMask(view, CameraOf(scene, view)));
  }
  return {};
}

// Poses by bundle adjustment, if that is better: `input` takes them over.
// Whether it does.
Result<bool> RunBundleAdjustment(const Workspace& workspace,
                                 const fs::path& staging,
                                 RunStages& stages,
                                 RunRecord& record,
                                 WorkspaceScene& input) {
  const fs::path log_path = staging / kAdjustmentLog;
  CURVIX_ASSIGN_OR_RETURN(PoseRefinement refined,
                          stages.AdjustPoses(input.model, log_path));
  if (fs::exists(log_path)) {
    record.result.files.push_back(log_path.filename().string());
  }
  if (!refined.model) return false;
  input.model = *std::move(refined.model);
  input.scene = MakeScene(workspace, input.model, input.missing_images);
  return true;
}

Result<LineCurves> ReadCurvesOfLines(const LinesSource& read,
                                     const Scene& scene,
                                     RunProgress& progress,
                                     RunRecord& record) {
  const Stopwatch stopwatch;
  progress.Update("read_lines", 0, 0);
  CURVIX_ASSIGN_OR_RETURN(const std::vector<ImportedLine> lines, read());
  CURVIX_ASSIGN_OR_RETURN(LineCurves curves, CurvesOfLines(lines, scene));
  record.stages.push_back(
      stopwatch.Read("read_lines",
                     {{"lines", static_cast<std::int64_t>(lines.size())},
                      {"left out", curves.num_left_out}}));
  progress.Finish(Plural(lines.size(), "line"));
  if (curves.num_seen < static_cast<int>(lines.size()) / 2) {
    progress.Note("Only " + std::to_string(curves.num_seen) + " of the lines " +
                  OneOrMore(curves.num_seen, "is", "are") +
                  " seen by an image of the model. If they "
                  "were made of another model, name its workspace with "
                  "--workspace_path.");
  }
  if (curves.num_unknown_images > 0) {
    progress.Note("Left out " + Plural(curves.num_unknown_images, "reference") +
                  " of lines to images that are not in the model. If the lines "
                  "were made of another model, name its workspace with "
                  "--workspace_path.");
  }
  if (curves.num_left_out > 0) {
    progress.Note("Left out " + Plural(curves.num_left_out, "line") +
                  " of length 0 or with an end too far away to be known.");
  }
  return curves;
}

}  // namespace

Result<WorkspaceRun> RunWorkspace(const RunSettings& settings,
                                  RunProgress& progress) {
  const Stopwatch since_start;
  WorkspaceRun run;
  RunRecord& record = run.record;
  record.settings = settings;
  CURVIX_ASSIGN_OR_RETURN(const Workspace workspace, FindInput(settings));
  CURVIX_ASSIGN_OR_RETURN(WorkspaceScene input,
                          ReadInput(workspace, progress, record));
  // Now, so that broken images or an unwritable folder are not found out after
  // much work.
  CURVIX_RETURN_IF_ERROR(CheckImages(input.scene));
  CURVIX_ASSIGN_OR_RETURN(StagedOutput output, CreateOutput(workspace));
  const fs::path& staging = output.folder();
  RunStages stages(workspace.output_path / "stages", progress, record);

  CURVIX_ASSIGN_OR_RETURN(
      const bool is_adjusted,
      RunBundleAdjustment(workspace, staging, stages, record, input));
  CURVIX_ASSIGN_OR_RETURN(
      run.stages, stages.Run(input.model, std::move(input.scene), nullptr));

  const std::optional<ColmapModel>& refined = run.stages.refined_model;
  if (is_adjusted || refined || input.is_scaled) {
    record.result.files.push_back(kModelFolder);
    CURVIX_RETURN_IF_ERROR(
        WriteColmapModel(refined ? *refined : input.model, staging / "sparse"));
  }
  const Reconstruction& reconstruction = run.stages.reconstruction;
  const CurvesInMemory curves(reconstruction.curves, &run.stages.edge_maps);
  Result<FittedCurves> fitted =
      WriteFindings(run.stages.scene,
                    {curves,
                     static_cast<std::int64_t>(reconstruction.edges.size()),
                     [&](const fs::path& path) {
                       return WriteEdges(path, reconstruction.edges);
                     },
                     reconstruction.report.why_empty},
                    staging,
                    record);
  if (!fitted.ok()) return fitted.status();
  CURVIX_RETURN_IF_ERROR(FinishRun(since_start, output, progress, record));
  run.fitted = *std::move(fitted);
  return run;
}

Result<RunRecord> RunLines(const RunSettings& settings,
                           const LinesSource& read,
                           RunProgress& progress) {
  const Stopwatch since_start;
  RunRecord record;
  record.settings = settings;
  CURVIX_ASSIGN_OR_RETURN(const Workspace workspace, FindInput(settings));
  CURVIX_ASSIGN_OR_RETURN(const WorkspaceScene input,
                          ReadInput(workspace, progress, record));
  CURVIX_ASSIGN_OR_RETURN(StagedOutput output, CreateOutput(workspace));
  CURVIX_ASSIGN_OR_RETURN(
      const LineCurves lines,
      ReadCurvesOfLines(read, input.scene, progress, record));
  const CurvesInMemory curves(lines.curves, &lines.edge_maps);
  Findings findings{curves};
  findings.is_repeatable = false;
  if (curves.size() == 0) findings.why_empty = "all lines were left out";
  CURVIX_RETURN_IF_ERROR(
      WriteFindings(input.scene, findings, output.folder(), record).status());
  CURVIX_RETURN_IF_ERROR(FinishRun(since_start, output, progress, record));
  return record;
}

}  // namespace curvix
