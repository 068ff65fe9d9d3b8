// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/run_parts.h"

#include <curvix/curve_io.h>
#include <curvix/reconstruct.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/cancelled.h"
#include "base/count_text.h"
#include "base/stopwatch.h"
#include "colmap/files.h"
#include "colmap/inconsistent_points.h"
#include "io/curve_formats.h"
#include "io/stage_io.h"
#include "parts/joined_curves.h"
#include "plugin/base/staged_output.h"
#include "plugin/run/file_hashes.h"
#include "plugin/run/part_files.h"
#include "plugin/run/run_stages.h"
#include "plugin/run/run_steps.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPartsName = "parts";
constexpr const char* kJoinStage = "join_parts";

RunRecord RecordOf(const RunSettings& settings) {
  RunRecord record;
  record.settings = settings;
  record.settings.poses.refiner = "none";
  record.settings.poses.refine_poses_with_curves = false;
  return record;
}

// Parts whose views are mostly those of others, too, are a waste.
void NoteOverlap(const ScenePartition& partition, RunProgress& progress) {
  constexpr std::size_t kMany = 3;
  std::size_t num_views = 0;
  std::size_t num_own_views = 0;
  for (const ScenePart& part : partition.parts) {
    num_views += part.view_idxs.size();
    num_own_views += part.own_view_idxs.size();
  }
  if (num_views <= kMany * num_own_views) return;
  progress.Note("Parts share most of their views: each view is in about " +
                std::to_string(num_views / num_own_views) +
                " parts, and costs as many times as much; larger parts share "
                "less (--max_views_per_part)");
}

// For the merge, which has only some of the points.
void NoteLargeErrors(const Scene& scene,
                     RunProgress& progress,
                     RunRecord& record) {
  const std::string note = LargeErrorsNote(scene);
  if (note.empty()) return;
  progress.Note(note);
  record.input.notes.push_back(note);
}

// Whether any part is done, of whatever plan.
bool HasResults(const fs::path& folder) {
  return std::ranges::any_of(EntriesOf(folder), [](const fs::path& entry) {
    return fs::exists(entry / kPartResultName);
  });
}

// Whether a new plan may take the place of `parts`, in which none is done.
Status CheckReplaceable(const fs::path& parts, bool is_plan) {
  const std::vector<fs::path> entries = EntriesOf(parts);
  if (!is_plan && !entries.empty()) {
    return Status::InvalidArgument(
        "The plan would replace " + parts.string() +
        ", which is no plan; remove it, or choose another folder with "
        "--output_path");
  }
  for (const fs::path& part : entries) {
    if (fs::is_directory(part) && !FolderLock::Take(part)) {
      return Status::InvalidArgument(part.string() +
                                     " is being reconstructed by the plan that "
                                     "is there; wait for its end");
    }
  }
  return {};
}

// Those of a model that 'partition' has written.
Status CheckImagesAreThere(const WorkspaceScene& input) {
  if (input.missing_images.empty()) return {};
  return Status::NotFound("Image " + input.missing_images.front() +
                          " is gone; bring it back");
}

// kNotFound if the model is no longer the one that was divided.
Status CheckModelIsSame(const fs::path& model_path,
                        const InputOfPlan& divided) {
  CURVIX_ASSIGN_OR_RETURN(const std::uint64_t hash, HashModel(model_path));
  if (hash == divided.model_hash) return {};
  return Status::NotFound(
      "The model " + model_path.string() +
      " has changed since it was divided; run 'colmap_curvix " +
      "partition' again");
}

// The model that was divided has more to say than that of the merge, which is
// without most of its points and the images that it lacks.
void TakeInputOfPlan(const InputOfPlan& divided,
                     RunProgress& progress,
                     InputSummary& input) {
  input.missing_images = divided.missing_images;
  for (const std::string& note : divided.notes) {
    if (std::ranges::find(input.notes, note) != input.notes.end()) continue;
    progress.Note(note);
    input.notes.push_back(note);
  }
}

// What a merge needs besides the parts.
Status CheckScene(const WorkspaceScene& input,
                  const PartPlan& plan,
                  const fs::path& folder) {
  CURVIX_RETURN_IF_ERROR(CheckImagesAreThere(input));
  if (input.scene.views.size() == plan.num_views) return {};
  return Status::DataLoss(
      (folder / "scene").string() +
      " does not fit the plan; run 'colmap_curvix partition' again");
}

Status CheckPartIdx(const PartPlan& plan, int part_idx) {
  const std::size_t num_parts = plan.partition.parts.size();
  if (part_idx >= 0 && static_cast<std::size_t>(part_idx) < num_parts) {
    return {};
  }
  return Status::NotFound("There is no part " + std::to_string(part_idx) +
                          "; the plan has the parts 0 to " +
                          std::to_string(num_parts - 1));
}

// The files of the 3D edges of all parts.
std::vector<fs::path> EdgesPaths(const PartPlan& plan, const fs::path& folder) {
  std::vector<fs::path> paths;
  for (std::size_t i = 0; i < plan.partition.parts.size(); ++i) {
    paths.push_back(PartFolder(folder, static_cast<int>(i)) / kPartEdgesName);
  }
  return paths;
}

}  // namespace

Result<ScenePartition> RunPartition(const RunSettings& settings,
                                    int max_views_per_part,
                                    RunProgress& progress) {
  CURVIX_ASSIGN_OR_RETURN(const Workspace workspace, FindInput(settings));
  CURVIX_ASSIGN_OR_RETURN(const std::uint64_t hash,
                          HashModel(workspace.model_path));
  RunRecord record = RecordOf(settings);
  CURVIX_ASSIGN_OR_RETURN(const WorkspaceScene input,
                          ReadInput(workspace, progress, record));
  progress.Update("partition_scene", 0, 0);
  CURVIX_ASSIGN_OR_RETURN(ScenePartition partition,
                          PartitionScene(input.scene, max_views_per_part));
  progress.Finish(Plural(partition.parts.size(), "part"));
  NoteLargeErrors(input.scene, progress, record);
  NoteOverlap(partition, progress);

  const fs::path folder = workspace.output_path / kPartsName;
  const Result<PartPlan> present = ReadPlan(folder);
  CURVIX_ASSIGN_OR_RETURN(StagedOutput output,
                          StagedOutput::Create(workspace.output_path));
  const bool is_same =
      present.ok() && present->text == PlanJson(partition, input.scene);
  const bool has_results = HasResults(folder);
  if (present.ok() && !is_same && has_results) {
    return Status::InvalidArgument("The plan in " + folder.string() +
                                   " is another one, and parts of it are done; "
                                   "to divide anew, remove this folder");
  }
  if (is_same) progress.Note("The plan is there already, and stays");
  // Beside finished parts; a merge finds those of another plan or model.
  const bool in_place = is_same || has_results;
  if (!in_place) {
    CURVIX_RETURN_IF_ERROR(CheckReplaceable(folder, present.ok()));
  }
  const fs::path written = in_place ? folder : output.folder() / kPartsName;
  CURVIX_RETURN_IF_ERROR(
      WritePlan(partition, input.scene, input.model, written));
  CURVIX_RETURN_IF_ERROR(WriteInputOfPlan(
      {hash, record.input.missing_images, record.input.notes}, written));
  if (progress.IsCancelled()) return CancelledStatus();
  if (!in_place) CURVIX_RETURN_IF_ERROR(output.Publish());
  return partition;
}

Result<RunRecord> RunPart(const RunSettings& settings,
                          int part_idx,
                          RunProgress& progress) {
  const Stopwatch since_start;
  CURVIX_ASSIGN_OR_RETURN(Workspace workspace, FindInput(settings));
  const fs::path parts = workspace.output_path / kPartsName;
  CURVIX_ASSIGN_OR_RETURN(const PartPlan plan, ReadPlan(parts));
  const fs::path folder = PartFolder(parts, part_idx);
  workspace.model_path = folder / "sparse";
  CURVIX_RETURN_IF_ERROR(CheckPartIdx(plan, part_idx));
  CURVIX_RETURN_IF_ERROR(CheckModelIsThere(workspace.model_path));
  workspace.output_path = folder;
  RunRecord record = RecordOf(settings);
  record.settings.output.formats.clear();  // parts have none of them
  CURVIX_ASSIGN_OR_RETURN(const WorkspaceScene input,
                          ReadInput(workspace, progress, record));
  CURVIX_RETURN_IF_ERROR(CheckImagesAreThere(input));
  CURVIX_ASSIGN_OR_RETURN(StagedOutput output, StagedOutput::Create(folder));
  const Options& options = settings.options;
  // Before they are used, so that no change in between goes unnoticed.
  CURVIX_ASSIGN_OR_RETURN(
      const auto image_hashes,
      HashImages(input.scene, options.runtime.num_threads, progress));
  RunStages stages(folder / "stages", progress, record, HashOf(image_hashes));
  CURVIX_ASSIGN_OR_RETURN(SceneStages found,
                          stages.Run(input.model, input.scene, nullptr));
  Reconstruction& reconstruction = found.reconstruction;

  PartResult part = TakePart(
      plan.partition, part_idx, reconstruction.curves, found.edge_maps);
  std::vector<Edge3d>& edges = reconstruction.edges;
  std::erase_if(edges, [&](const Edge3d& edge) {
    return OwnerOf(plan.partition, edge.position) != part_idx;
  });
  part.num_core_edges_3d = static_cast<std::int64_t>(edges.size());
  for (const TracedCurve& traced : part.curves) {
    Count(traced.curve, record.result);
  }
  record.result.num_edges_3d = part.num_core_edges_3d;
  if (part.curves.empty()) {
    const std::string& why = reconstruction.report.why_empty;
    record.result.why_empty = why.empty() ? "all lie in other parts" : why;
  }
  CURVIX_RETURN_IF_ERROR(WriteEdges(output.folder() / kPartEdgesName, edges));
  CURVIX_RETURN_IF_ERROR(
      WritePartResult(output.folder() / kPartResultName,
                      PartKey(plan, part_idx, options, image_hashes),
                      part));
  CURVIX_RETURN_IF_ERROR(FinishRun(since_start, output, progress, record));
  return record;
}

Result<RunRecord> RunMerge(const RunSettings& settings, RunProgress& progress) {
  const Stopwatch since_start;
  CURVIX_ASSIGN_OR_RETURN(Workspace workspace, FindInput(settings));
  const fs::path model_path = workspace.model_path;
  const fs::path folder = workspace.output_path / kPartsName;
  CURVIX_ASSIGN_OR_RETURN(const PartPlan plan, ReadPlan(folder));
  workspace.model_path = folder / "scene";
  CURVIX_RETURN_IF_ERROR(CheckModelIsThere(workspace.model_path));
  RunRecord record = RecordOf(settings);
  CURVIX_ASSIGN_OR_RETURN(const WorkspaceScene input,
                          ReadInput(workspace, progress, record));
  CURVIX_ASSIGN_OR_RETURN(const InputOfPlan divided, ReadInputOfPlan(folder));
  CURVIX_RETURN_IF_ERROR(CheckModelIsSame(model_path, divided));
  CURVIX_RETURN_IF_ERROR(CheckScene(input, plan, folder));
  TakeInputOfPlan(divided, progress, record.input);
  record.settings.input_path = fs::absolute(model_path);
  record.settings.command = "merge";
  CURVIX_ASSIGN_OR_RETURN(StagedOutput output, CreateOutput(workspace));
  CURVIX_ASSIGN_OR_RETURN(
      const auto image_hashes,
      HashImages(input.scene, settings.options.runtime.num_threads, progress));

  const Stopwatch since_join;
  progress.Update(kJoinStage, 0, 0);
  CURVIX_ASSIGN_OR_RETURN(
      PartFiles parts,
      PartFiles::Open(plan, settings.options, image_hashes, folder, progress));
  const JoinedCurves curves(
      plan.partition, parts, input.scene, settings.options);
  CURVIX_RETURN_IF_ERROR(curves.status());
  if (settings.clean) StageStore(workspace.output_path / "stages").Clean();
  const std::size_t num_parts = plan.partition.parts.size();
  record.stages.push_back(
      since_join.Read(kJoinStage,
                      {{"parts", static_cast<std::int64_t>(num_parts)},
                       {"curves", static_cast<std::int64_t>(curves.size())}}));
  record.result.num_edges_2d = parts.num_edges_2d();
  Findings findings{curves, parts.num_edges_3d()};
  findings.write_edges = [&](const fs::path& path) {
    return ConcatenatePlyEdges(path, EdgesPaths(plan, folder));
  };
  if (curves.size() == 0) {
    findings.why_empty =
        "no part has any; report.json in the folders of the parts says more";
  }
  CURVIX_RETURN_IF_ERROR(
      WriteFindings(input.scene, findings, output.folder(), record).status());
  CURVIX_RETURN_IF_ERROR(FinishRun(since_start, output, progress, record));
  return record;
}

}  // namespace curvix
