// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/run_workspace.h"

#include <curvix/curve_io.h>
#include <curvix/curves.h>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/cancelled.h"
#include "base/stopwatch.h"
#include "colmap/colmap_model.h"
#include "plugin/base/file_errors.h"
#include "plugin/base/staged_output.h"
#include "plugin/poses/curve_poses.h"
#include "plugin/poses/pose_refinement.h"
#include "plugin/run/run_stages.h"
#include "plugin/run/run_steps.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// One run, from the first file read to the last one written.
class WorkspaceJob {
 public:
  WorkspaceJob(const RunSettings& settings, RunProgress& progress)
      : progress_(progress) {
    record_.settings = settings;
  }

  Result<WorkspaceRun> Run();

 private:
  Result<Scene> RefinePoses(const WorkspaceScene& input);
  Result<Scene> RefinePosesWithCurves(const WorkspaceScene& input,
                                      const Scene& scene,
                                      const std::vector<EdgeMap>& edge_maps,
                                      RunStages& stages);
  Status WriteRefinedModel();

  void Note(const std::vector<std::string>& notes) {
    for (const std::string& note : notes) progress_.Note(note);
  }

  RunProgress& progress_;
  Stopwatch since_start_;
  Workspace workspace_;
  fs::path staging_;
  std::optional<ColmapModel> refined_model_;
  RunRecord record_;
};

Result<WorkspaceRun> WorkspaceJob::Run() {
  Result<Workspace> workspace = FindInput(record_.settings);
  if (!workspace.ok()) return workspace.status();
  workspace_ = *std::move(workspace);
  Result<WorkspaceScene> input = ReadInput(workspace_, progress_, record_);
  if (!input.ok()) return input.status();
  // Now, so that an unwritable folder is not found out after all the work.
  Result<StagedOutput> output = StagedOutput::Create(workspace_.output_path);
  if (!output.ok()) return output.status();
  staging_ = output->folder();
  RunStages stages(workspace_.output_path / "stages", progress_, record_);

  Result<Scene> scene = RefinePoses(*input);
  if (!scene.ok()) return scene.status();
  Result<std::vector<EdgeMap>> edge_maps = stages.Detect(*scene);
  if (!edge_maps.ok()) return edge_maps.status();
  if (record_.settings.poses.refine_poses_with_curves) {
    Result<Scene> refined =
        RefinePosesWithCurves(*input, *scene, *edge_maps, stages);
    if (!refined.ok()) return refined.status();
    edge_maps =
        EdgesWithCameras(*scene, *std::move(edge_maps), refined->cameras);
    if (!edge_maps.ok()) return edge_maps.status();
    scene = std::move(refined);
  }
  Result<Reconstruction> reconstruction =
      stages.Reconstruct(*scene, *edge_maps);
  if (!reconstruction.ok()) return stages.KeptStages(reconstruction.status());

  Status written = WriteRefinedModel();
  if (!written.ok()) return written;
  const CurvesInMemory curves(reconstruction->curves, &*edge_maps);
  Result<FittedCurves> fitted =
      WriteFindings(*scene,
                    {curves,
                     static_cast<std::int64_t>(reconstruction->edges.size()),
                     [&](const fs::path& path) {
                       return WriteEdges(path, reconstruction->edges);
                     },
                     reconstruction->report.why_empty},
                    staging_,
                    record_);
  if (!fitted.ok()) return fitted.status();
  written = WriteReport(since_start_, staging_, progress_, record_);
  if (!written.ok()) return written;
  if (progress_.IsCancelled()) return CancelledStatus();
  // Those of an earlier run would tell of other poses.
  Status published = output->Publish({"sparse", "bundle_adjuster.log"});
  if (!published.ok()) return published;
  return WorkspaceRun{std::move(record_),
                      *std::move(scene),
                      *std::move(edge_maps),
                      std::move(reconstruction->curves),
                      *std::move(fitted)};
}

// The scene with the refined poses, which are written to sparse/ too, or as it
// was.
Result<Scene> WorkspaceJob::RefinePoses(const WorkspaceScene& input) {
  const Stopwatch stopwatch;
  Result<PoseRefinement> refined =
      curvix::RefinePoses(input.model,
                          record_.settings.poses,
                          staging_ / "bundle_adjuster.log",
                          progress_.Callback());
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

// The same with the edges of the views.
Result<Scene> WorkspaceJob::RefinePosesWithCurves(
    const WorkspaceScene& input,
    const Scene& scene,
    const std::vector<EdgeMap>& edge_maps,
    RunStages& stages) {
  Result<CurvePoseRefinement> refined = stages.RefinePosesWithCurves(
      refined_model_ ? *refined_model_ : input.model, scene, edge_maps);
  if (!refined.ok()) return stages.KeptStages(refined.status());
  if (!refined->model) return scene;
  refined_model_ = std::move(refined->model);
  return MakeScene(workspace_, *refined_model_, input.missing_images);
}

Status WorkspaceJob::WriteRefinedModel() {
  if (!refined_model_) return {};
  record_.result.files.push_back("sparse/");
  return WriteColmapModel(*refined_model_, staging_ / "sparse");
}

}  // namespace

Result<WorkspaceRun> RunWorkspace(const RunSettings& settings,
                                  RunProgress& progress) {
  return CatchFileErrors(StatusCode::kNotFound, [&] {
    return WorkspaceJob(settings, progress).Run();
  });
}

}  // namespace curvix
