// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run_stages.h"

#include <curvix/stopwatch.h>

#include <optional>
#include <string>
#include <utility>

namespace curvix {

RunStages::RunStages(std::filesystem::path folder,
                     ProgressPrinter& progress,
                     RunRecord& record)
    : store_(std::move(folder)), progress_(progress), record_(record) {
  if (record.settings.clean) store_.Clean();
}

Result<std::vector<EdgeMap>> RunStages::Detect(const Scene& scene) {
  const Stopwatch stopwatch;
  progress_.Update("detect_edges", 0, 0);
  const std::uint64_t key = EdgesKey(scene, record_.settings.options);
  Result<std::vector<EdgeMap>> edge_maps = Status();
  if (auto saved = store_.LoadEdges(key)) edge_maps = *std::move(saved);
  const bool is_resumed = edge_maps.ok();
  if (!is_resumed) {
    edge_maps =
        DetectEdges(scene, record_.settings.options, progress_.Callback());
    if (!edge_maps.ok()) return edge_maps.status();
    Save(key, *edge_maps);
  }
  StageCounts counts = CountEdges(*edge_maps);
  record_.result.num_edges_2d = counts.front().second;
  counts.insert(counts.begin(), {"views", record_.input.num_views});
  std::string text = CountsText(counts);
  FinishStage(stopwatch.Read("detect_edges"),
              std::move(counts),
              std::move(text),
              is_resumed);
  return edge_maps;
}

Result<CurvePoseRefinement> RunStages::RefinePosesWithCurves(
    const ColmapModel& model,
    const Scene& scene,
    const std::vector<EdgeMap>& edge_maps) {
  const Stopwatch stopwatch;
  progress_.Update("refine_poses_with_curves", 0, 0);
  const Options& options = record_.settings.options;
  const std::uint64_t key =
      CurvePosesKey(scene, options, record_.settings.poses.refine_intrinsics);
  std::optional<CurvePoses> poses = store_.LoadCurvePoses(key);
  const bool is_resumed = poses.has_value();
  if (!is_resumed) {
    Result<CurvePoses> refined =
        curvix::RefinePosesWithCurves(scene,
                                      edge_maps,
                                      options,
                                      progress_.Callback(),
                                      record_.settings.poses.refine_intrinsics);
    if (!refined.ok()) return refined.status();
    poses = std::move(refined).value();
    Save(key, *poses);
  }
  CurvePoseRefinement result =
      ModelWithCurvePoses(model, scene, *std::move(poses));
  record_.curve_poses = result.record;
  FinishStage(stopwatch.Read("refine_poses_with_curves"),
              {},
              CurvePosesText(result.record),
              is_resumed);
  return result;
}

Result<EdgeSketch> RunStages::Sketch(const Scene& scene,
                                     const std::vector<EdgeMap>& edge_maps) {
  const Stopwatch stopwatch;
  progress_.Update("sketch_edges", 0, 0);
  const std::uint64_t key = SketchKey(scene, record_.settings.options);
  Result<EdgeSketch> sketch = Status();
  if (auto saved = store_.LoadSketch(key)) sketch = *std::move(saved);
  const bool is_resumed = sketch.ok();
  if (!is_resumed) {
    sketch = SketchEdges(
        scene, edge_maps, record_.settings.options, progress_.Callback());
    if (!sketch.ok()) return sketch;
    Save(key, *sketch);
  }
  record_.result.edge_sigma_px = sketch->edge_sigma_px;
  FinishStage(
      stopwatch.Read("sketch_edges"), CountsOf(*sketch), "", is_resumed);
  return sketch;
}

void RunStages::FinishStage(StageReport report,
                            StageCounts counts,
                            std::string text,
                            bool is_resumed) {
  if (is_resumed) record_.resumed_stages.push_back(report.name);
  if (is_resumed) {
    text += std::string(text.empty() ? "" : ", ") + "as an earlier run left it";
  }
  progress_.Finish(text);
  record_.stages.push_back(std::move(report));
  record_.stages.back().counts = std::move(counts);
}

template <typename T>
void RunStages::Save(std::uint64_t key, const T& result) {
  if (record_.settings.clean) return;
  const std::string problem = store_.Save(key, result);
  if (!problem.empty()) {
    progress_.Note("A later run will not be able to go on from here: " +
                   problem);
  }
}

Status RunStages::KeptStages(Status status) const {
  if (status.code() != StatusCode::kCancelled || !store_.has_saved()) {
    return status;
  }
  return {status.code(),
          "interrupted; no results were written, but finished stages are kept: "
          "the same command goes on from there"};
}

Result<Reconstruction> RunStages::Reconstruct(
    const Scene& scene, const std::vector<EdgeMap>& edge_maps) {
  const Result<EdgeSketch> sketch = Sketch(scene, edge_maps);
  if (!sketch.ok()) return sketch.status();
  Result<Reconstruction> reconstruction =
      CurvesFromSketch(scene,
                       edge_maps,
                       *sketch,
                       record_.settings.options,
                       progress_.Callback());
  if (!reconstruction.ok()) return reconstruction.status();
  progress_.Finish();
  for (const StageReport& stage : reconstruction->report.stages) {
    record_.stages.push_back(stage);
  }
  return reconstruction;
}

}  // namespace curvix
