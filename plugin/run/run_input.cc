// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/run_input.h"

#include <curvix/scene.h>
#include <cstdint>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "plugin/align/alignment_file.h"
#include "plugin/run/text.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// An output folder in which results would lie among the inputs, project.ini
// over COLMAP's.
Status CheckOutputPath(const Workspace& workspace) {
  const fs::path output = fs::weakly_canonical(workspace.output_path);
  for (const fs::path& input :
       {workspace.model_path, workspace.image_path, workspace.mask_path}) {
    if (!input.empty() && output == fs::weakly_canonical(input)) {
      return {StatusCode::kInvalidArgument,
              "the results would be written among the inputs in " +
                  output.string() +
                  "; choose another folder with --output_path"};
    }
  }
  return {};
}

InputSummary SummarizeInput(const Workspace& workspace,
                            const WorkspaceScene& input) {
  InputSummary summary;
  summary.model_path = fs::absolute(workspace.model_path);
  summary.image_path = fs::absolute(workspace.image_path);
  summary.mask_path = workspace.mask_path;
  for (const Camera& camera : input.scene.cameras) {
    summary.camera_models.emplace_back(ModelName(camera.model));
  }
  summary.num_views = static_cast<std::int64_t>(input.scene.views.size());
  summary.num_points = static_cast<std::int64_t>(input.scene.points.size());
  summary.missing_images = input.missing_images;
  return summary;
}

}  // namespace

Result<Workspace> FindInput(const RunSettings& settings) {
  Result<Workspace> workspace = FindWorkspace({settings.workspace_path,
                                               settings.input_path,
                                               settings.image_path,
                                               settings.output_path,
                                               settings.mask_path});
  if (!workspace.ok()) return workspace;
  Status usable = CheckOutputPath(*workspace);
  if (!usable.ok()) return usable;
  return workspace;
}

Workspace WithRefinedModel(Workspace workspace) {
  const fs::path refined = workspace.output_path / "sparse";
  if (fs::exists(refined)) workspace.model_path = refined;
  return workspace;
}

Result<WorkspaceScene> ReadInput(const Workspace& workspace,
                                 RunProgress& progress,
                                 RunRecord& record) {
  const Stopwatch stopwatch;
  progress.Update("read_model", 0, 0);
  Result<WorkspaceScene> input = LoadWorkspaceScene(workspace);
  if (!input.ok()) return input.status();

  Result<std::optional<WorldAlignment>> alignment =
      ReadAlignment(workspace.output_path);
  if (!alignment.ok()) return alignment.status();
  record.alignment = *std::move(alignment);

  RunSettings& settings = record.settings;
  settings.workspace_path = fs::absolute(settings.workspace_path);
  settings.input_path = fs::absolute(workspace.model_path);
  settings.image_path = fs::absolute(workspace.image_path);
  settings.output_path = fs::absolute(workspace.output_path);
  settings.mask_path = workspace.mask_path;
  record.input = SummarizeInput(workspace, *input);
  record.result.output_path = workspace.output_path;
  record.stages.push_back(stopwatch.Read("read_model"));
  record.stages.back().counts = {
      {"views", record.input.num_views},
      {"missing images",
       static_cast<std::int64_t>(record.input.missing_images.size())},
      {"points", record.input.num_points}};
  progress.Finish(GroupDigits(record.input.num_views) + " views, " +
                  GroupDigits(record.input.num_points) + " points");
  for (const std::string& note : workspace.notes) progress.Note(note);
  for (const std::string& note : input->notes) progress.Note(note);
  if (record.alignment) {
    progress.Note("The results are in the frame of " +
                  (workspace.output_path / kAlignmentName).string());
  }
  return input;
}

}  // namespace curvix
