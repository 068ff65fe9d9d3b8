// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run_workspace.h"

#include <curvix/camera_model.h>
#include <curvix/curve_io.h>
#include <curvix/file_io.h>
#include <curvix/fitting.h>
#include <curvix/reconstruct.h>
#include <curvix/stopwatch.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plugin/colmap_model.h"
#include "plugin/curve_poses.h"
#include "plugin/pose_refinement.h"
#include "plugin/run_counts.h"
#include "plugin/stage_store.h"
#include "plugin/staged_output.h"
#include "plugin/text.h"
#include "plugin/workspace.h"
#include "plugin/write_results.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

Status Cancelled() {
  return {StatusCode::kCancelled, "interrupted; nothing was written"};
}

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

// One run, from the first file read to the last one written.
class Job {
 public:
  Job(const RunSettings& settings, ProgressPrinter& progress)
      : progress_(progress) {
    record_.settings = settings;
  }

  Result<RunRecord> Run();

 private:
  Result<WorkspaceScene> Read();
  Result<Scene> RefinePoses(const WorkspaceScene& input);
  Result<Scene> RefinePosesWithCurves(const WorkspaceScene& input,
                                      const Scene& scene,
                                      const std::vector<EdgeMap>& edge_maps);
  Result<std::vector<EdgeMap>> Detect(const Scene& scene);
  Result<Reconstruction> Reconstruct(const Scene& scene,
                                     const std::vector<EdgeMap>& edge_maps);
  Result<EdgeSketch> Sketch(const Scene& scene,
                            const std::vector<EdgeMap>& edge_maps);
  void FinishStage(StageReport report, StageCounts counts, bool is_resumed);
  template <typename T>
  void Save(std::uint64_t key, const T& result);
  Status KeptStages(Status status) const;
  Status Write(const Scene& scene,
               const std::vector<EdgeMap>& edge_maps,
               const Reconstruction& reconstruction);
  Status WriteCurveFiles(const Scene& scene,
                         const std::vector<EdgeMap>& edge_maps,
                         const CurveSet& curves);
  Status WriteReport();

  Progress Callback() {
    return [this](const std::string& stage, int done, int total) {
      return progress_.Update(stage, done, total);
    };
  }
  void Note(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) progress_.Note(note);
  }

  ProgressPrinter& progress_;
  Stopwatch since_start_;
  Workspace workspace_;
  fs::path staging_;
  std::optional<ColmapModel> refined_model_;
  std::optional<StageStore> stages_;
  RunRecord record_;
};

Result<RunRecord> Job::Run() {
  Result<WorkspaceScene> input = Read();
  if (!input.ok()) return input.status();
  // Now, so that an unwritable folder is not found out after all the work.
  Result<StagedOutput> output = StagedOutput::Create(workspace_.output_path);
  if (!output.ok()) return output.status();
  staging_ = output->folder();
  stages_.emplace(workspace_.output_path / "stages");
  if (record_.settings.clean) stages_->Clean();

  Result<Scene> scene = RefinePoses(*input);
  if (!scene.ok()) return scene.status();
  const Result<std::vector<EdgeMap>> edge_maps = Detect(*scene);
  if (!edge_maps.ok()) return edge_maps.status();
  if (record_.settings.poses.refine_poses_with_curves) {
    scene = RefinePosesWithCurves(*input, *scene, *edge_maps);
    if (!scene.ok()) return scene.status();
  }
  const Result<Reconstruction> reconstruction = Reconstruct(*scene, *edge_maps);
  if (!reconstruction.ok()) return KeptStages(reconstruction.status());

  const Status written = Write(*scene, *edge_maps, *reconstruction);
  if (!written.ok()) return written;
  if (IsInterrupted()) return Cancelled();
  // Those of an earlier run would tell of other poses.
  const Status published = output->Publish({"sparse", "bundle_adjuster.log"});
  if (!published.ok()) return published;
  return std::move(record_);
}

Result<WorkspaceScene> Job::Read() {
  const Stopwatch stopwatch;
  progress_.Update("read_model", 0, 0);
  RunSettings& settings = record_.settings;
  Result<Workspace> workspace = FindWorkspace({settings.workspace_path,
                                               settings.input_path,
                                               settings.image_path,
                                               settings.output_path,
                                               settings.mask_path});
  if (!workspace.ok()) return workspace.status();
  workspace_ = *workspace;
  const Status usable = CheckOutputPath(workspace_);
  if (!usable.ok()) return usable;
  Result<WorkspaceScene> input = LoadWorkspaceScene(workspace_);
  if (!input.ok()) return input.status();

  settings.workspace_path = fs::absolute(settings.workspace_path);
  settings.input_path = fs::absolute(workspace_.model_path);
  settings.image_path = fs::absolute(workspace_.image_path);
  settings.output_path = fs::absolute(workspace_.output_path);
  settings.mask_path = workspace_.mask_path;
  record_.input = SummarizeInput(workspace_, *input);
  record_.stages.push_back(stopwatch.Read("read_model"));
  record_.stages.back().counts = {
      {"views", record_.input.num_views},
      {"missing images",
       static_cast<std::int64_t>(record_.input.missing_images.size())},
      {"points", record_.input.num_points}};
  progress_.Finish(GroupDigits(record_.input.num_views) + " views, " +
                   GroupDigits(record_.input.num_points) + " points");
  Note(workspace_.notes);
  Note(input->notes);
  return input;
}

// The scene with the refined poses, which are written to sparse/ too, or as it
// was.
Result<Scene> Job::RefinePoses(const WorkspaceScene& input) {
  const Stopwatch stopwatch;
  Result<PoseRefinement> refined =
      curvix::RefinePoses(input.model,
                          record_.settings.poses,
                          staging_ / "bundle_adjuster.log",
                          Callback());
  if (!refined.ok()) return refined.status();
  record_.poses = refined->record;
  if (record_.settings.poses.refiner != "none") {
    record_.stages.push_back(stopwatch.Read("refine_poses"));
    progress_.Finish(PoseRefinementText(record_.poses));
  }
  Note(refined->notes);
  if (fs::exists(staging_ / "bundle_adjuster.log")) {
    record_.result.files.push_back("bundle_adjuster.log");
  }
  if (!refined->model) return input.scene;
  refined_model_ = std::move(refined->model);
  return MakeScene(workspace_, *refined_model_, input.missing_images);
}

// The same with the edges of the views, which stay where they are.
Result<Scene> Job::RefinePosesWithCurves(
    const WorkspaceScene& input,
    const Scene& scene,
    const std::vector<EdgeMap>& edge_maps) {
  const Stopwatch stopwatch;
  Result<CurvePoseRefinement> refined =
      RefineModelWithCurves(refined_model_ ? *refined_model_ : input.model,
                            scene,
                            edge_maps,
                            record_.settings.options,
                            Callback());
  if (!refined.ok()) return refined.status();
  record_.curve_poses = std::move(refined->record);
  record_.stages.push_back(stopwatch.Read("refine_poses_with_curves"));
  progress_.Finish(CurvePosesText(*record_.curve_poses));
  if (!refined->model) return scene;
  refined_model_ = std::move(refined->model);
  return MakeScene(workspace_, *refined_model_, input.missing_images);
}

Result<std::vector<EdgeMap>> Job::Detect(const Scene& scene) {
  const Stopwatch stopwatch;
  progress_.Update("detect_edges", 0, 0);
  const std::uint64_t key = EdgesKey(scene, record_.settings.options);
  Result<std::vector<EdgeMap>> edge_maps = Status();
  if (auto saved = stages_->LoadEdges(key)) edge_maps = *std::move(saved);
  const bool is_resumed = edge_maps.ok();
  if (!is_resumed) {
    edge_maps = DetectEdges(scene, record_.settings.options, Callback());
    if (!edge_maps.ok()) return edge_maps.status();
    Save(key, *edge_maps);
  }
  StageCounts counts = CountEdges(*edge_maps);
  record_.result.num_edges_2d = counts.front().second;
  counts.insert(counts.begin(), {"views", record_.input.num_views});
  FinishStage(stopwatch.Read("detect_edges"), std::move(counts), is_resumed);
  return edge_maps;
}

Result<EdgeSketch> Job::Sketch(const Scene& scene,
                               const std::vector<EdgeMap>& edge_maps) {
  const Stopwatch stopwatch;
  progress_.Update("sketch_edges", 0, 0);
  const std::uint64_t key = SketchKey(scene, record_.settings.options);
  Result<EdgeSketch> sketch = Status();
  if (auto saved = stages_->LoadSketch(key)) sketch = *std::move(saved);
  const bool is_resumed = sketch.ok();
  if (!is_resumed) {
    sketch =
        SketchEdges(scene, edge_maps, record_.settings.options, Callback());
    if (!sketch.ok()) return sketch;
    Save(key, *sketch);
  }
  FinishStage(stopwatch.Read("sketch_edges"), CountsOf(*sketch), is_resumed);
  return sketch;
}

void Job::FinishStage(StageReport report, StageCounts counts, bool is_resumed) {
  if (is_resumed) record_.resumed_stages.push_back(report.name);
  const bool tells_counts = report.name == "detect_edges";
  std::string text = tells_counts ? CountsText(counts) : "";
  if (is_resumed) {
    text += std::string(text.empty() ? "" : ", ") + "as an earlier run left it";
  }
  progress_.Finish(text);
  record_.stages.push_back(std::move(report));
  record_.stages.back().counts = std::move(counts);
}

template <typename T>
void Job::Save(std::uint64_t key, const T& result) {
  if (record_.settings.clean) return;
  const std::string problem = stages_->Save(key, result);
  if (!problem.empty()) {
    progress_.Note("A later run will not be able to go on from here: " +
                   problem);
  }
}

// What an interrupted run leaves behind.
Status Job::KeptStages(Status status) const {
  if (status.code() != StatusCode::kCancelled || !stages_->has_saved()) {
    return status;
  }
  return {status.code(),
          "interrupted; no results were written, but finished stages are kept: "
          "the same command goes on from there"};
}

Result<Reconstruction> Job::Reconstruct(const Scene& scene,
                                        const std::vector<EdgeMap>& edge_maps) {
  const Result<EdgeSketch> sketch = Sketch(scene, edge_maps);
  if (!sketch.ok()) return sketch.status();
  Result<Reconstruction> reconstruction = CurvesFromSketch(
      scene, edge_maps, *sketch, record_.settings.options, Callback());
  if (!reconstruction.ok()) return reconstruction.status();
  progress_.Finish();
  for (const StageReport& stage : reconstruction->report.stages) {
    record_.stages.push_back(stage);
  }
  const std::int64_t num_edges_2d = record_.result.num_edges_2d;
  std::vector<std::string> files = std::move(record_.result.files);
  record_.result = SummarizeCurves(reconstruction->curves);
  record_.result.files = std::move(files);
  record_.result.output_path = workspace_.output_path;
  record_.result.num_edges_2d = num_edges_2d;
  record_.result.num_edges_3d =
      static_cast<std::int64_t>(reconstruction->edges.size());
  record_.result.why_empty = reconstruction->report.why_empty;
  return reconstruction;
}

Status Job::Write(const Scene& scene,
                  const std::vector<EdgeMap>& edge_maps,
                  const Reconstruction& reconstruction) {
  const Stopwatch stopwatch;
  Status status;
  if (refined_model_) {
    status = WriteColmapModel(
        *refined_model_, staging_ / "sparse", ColmapFormat::kBinary);
    if (!status.ok()) return status;
    record_.result.files.push_back("sparse/");
  }
  if (!reconstruction.curves.curves.empty()) {
    status = WriteCurveFiles(scene, edge_maps, reconstruction.curves);
  }
  if (status.ok() && !reconstruction.edges.empty()) {
    record_.result.files.push_back("edges.ply");
    status = WriteEdges(staging_ / "edges.ply", reconstruction.edges);
  }
  if (!status.ok()) return status;
  record_.stages.push_back(stopwatch.Read("write_files"));
  return WriteReport();
}

Status Job::WriteCurveFiles(const Scene& scene,
                            const std::vector<EdgeMap>& edge_maps,
                            const CurveSet& curves) {
  const Stopwatch stopwatch;
  const FittedCurves fitted =
      FitCurves(curves,
                scene,
                record_.settings.options.curve_fitting,
                record_.settings.options.runtime.num_threads);
  record_.stages.push_back(stopwatch.Read("fit_curves"));
  record_.stages.back().counts = CountFits(fitted);
  Result<std::vector<std::string>> written = WriteResults(
      {scene, edge_maps, curves, fitted}, record_.settings.output, staging_);
  if (!written.ok()) return written.status();
  std::vector<std::string>& files = record_.result.files;
  files.insert(files.end(), written->begin(), written->end());
  files.push_back("project.ini");
  return WriteFileAtomically(staging_ / "project.ini",
                             ProjectFile(record_.settings));
}

Status Job::WriteReport() {
  record_.result.files.push_back("report.json");
  record_.total = since_start_.Read("total");
  progress_.Finish();
  return WriteFileAtomically(staging_ / "report.json", ReportJson(record_));
}

}  // namespace

Result<RunRecord> RunWorkspace(const RunSettings& settings,
                               ProgressPrinter& progress) {
  try {
    return Job(settings, progress).Run();
  } catch (const fs::filesystem_error& error) {
    return Status(StatusCode::kNotFound, error.what());
  }
}

}  // namespace curvix
