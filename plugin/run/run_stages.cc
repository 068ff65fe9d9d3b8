// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/run/run_stages.h"

#include <map>
#include <utility>

#include "base/count_text.h"
#include "colmap/inconsistent_points.h"
#include "edge_detection/curvelets.h"
#include "plugin/poses/curve_poses.h"

namespace curvix {
namespace {

std::string RepeatedViewsText(std::int64_t num_views) {
  if (num_views == 0) return "";
  return Plural(num_views, "view") +
         (num_views == 1 ? " that repeats another" : " that repeat others") +
         " left out (Validation.min_view_angle_deg)";
}

// How many edges there are in all views; those left out, if any are.
StageCounts CountEdges(const std::vector<EdgeMap>& edge_maps) {
  std::int64_t num_edges = 0, num_masked = 0;
  std::int64_t num_isolated = 0, num_over_limit = 0;
  for (const EdgeMap& map : edge_maps) {
    num_edges += static_cast<std::int64_t>(map.edges.size());
    num_masked += map.num_dropped_masked;
    num_isolated += map.num_dropped_isolated;
    num_over_limit += map.num_dropped_over_limit;
  }
  StageCounts counts = {{"edges", num_edges}};
  if (num_masked > 0) counts.emplace_back("left out by masks", num_masked);
  if (num_isolated > 0) {
    counts.emplace_back("left out as noise", num_isolated);
  }
  if (num_over_limit > 0) {
    counts.emplace_back(
        "weak, short or crowded ones left out "
        "(EdgeDetection.max_edges_per_megapixel)",
        num_over_limit);
  }
  return counts;
}

// "8 views, 123 edges"
std::string CountsText(const StageCounts& counts) {
  std::string text;
  for (const auto& [name, count] : counts) {
    text += (text.empty() ? "" : ", ") + CountText(count, name);
  }
  return text;
}

}  // namespace

RunStages::RunStages(std::filesystem::path folder,
                     RunProgress& progress,
                     RunRecord& record,
                     std::uint64_t images_key)
    : store_(std::move(folder), images_key),
      progress_(progress),
      record_(record) {
  if (record.settings.clean) store_.Clean();
}

// The result of a stage as an earlier run left it, which the record tells, or
// else what `make` gives, which is kept.
template <typename T, typename Make>
Result<T> RunStages::LoadOrMake(const StoredStage<T>& stage,
                                std::uint64_t key,
                                const Make& make) {
  progress_.Update(stage.name, 0, 0);
  if (std::optional<T> saved = store_.Load(stage, key)) {
    record_.resumed_stages.push_back(stage.name);
    return *std::move(saved);
  }
  Result<T> made = make();
  if (!made.ok() || record_.settings.clean) return made;
  const std::string problem = store_.Save(stage, key, *made);
  if (!problem.empty()) {
    progress_.Note("A later run cannot resume from here: " + problem);
  }
  return made;
}

// What COLMAP said stays beside its result, for the runs that resume from it.
Result<BundleAdjustment> RunStages::LoadOrAdjust(
    const Scene& scene,
    const std::filesystem::path& program,
    const std::function<Result<BundleAdjustment>()>& adjust,
    const std::filesystem::path& log_path) {
  bool is_new = false;
  Result<BundleAdjustment> adjustment =
      LoadOrMake(kRefinePoses, AdjustmentKey(scene, program), [&] {
        is_new = true;
        return adjust();
      });
  if (!adjustment.ok()) return adjustment;
  if (!is_new) {
    store_.FetchText(log_path);
  } else if (!record_.settings.clean) {
    store_.KeepText(log_path);
  }
  return adjustment;
}

Result<PoseRefinement> RunStages::AdjustPoses(
    const ColmapModel& model, const std::filesystem::path& log_path) {
  const Stopwatch stopwatch;
  const PoseRefinementSettings& settings = record_.settings.poses;
  Result<PoseRefinement> refined = curvix::RefinePoses(
      model,
      settings,
      log_path,
      progress_.Callback(),
      [&](const Scene& scene,
          const std::filesystem::path& program,
          const std::function<Result<BundleAdjustment>()>& adjust) {
        return LoadOrAdjust(scene, program, adjust, log_path);
      });
  if (!refined.ok()) return KeptStages(refined.status());
  record_.poses = refined->record;
  if (settings.refiner != "none") {
    FinishStage(stopwatch.Read(kRefinePoses.name),
                PoseRefinementText(record_.poses));
  }
  for (const std::string& note : refined->notes) progress_.Note(note);
  return refined;
}

Result<SceneStages> RunStages::Run(const ColmapModel& model,
                                   Scene scene,
                                   const std::vector<EdgeMap>* edges) {
  SceneStages stages;
  Result<std::vector<EdgeMap>> edge_maps =
      edges == nullptr ? Detect(scene) : Link(*edges);
  if (!edge_maps.ok()) return KeptStages(edge_maps.status());
  stages.scene = std::move(scene);
  stages.edge_maps = *std::move(edge_maps);
  if (record_.settings.poses.refine_poses_with_curves) {
    const Status status = RefinePoses(model, stages);
    if (!status.ok()) return KeptStages(status);
  }
  const std::string note = LargeErrorsNote(stages.scene);
  if (!note.empty()) {
    record_.input.notes.push_back(note);
    progress_.Note(note);
  }
  Result<Reconstruction> found = Reconstruct(stages.scene, stages.edge_maps);
  if (!found.ok()) return KeptStages(found.status());
  stages.reconstruction = *std::move(found);
  return stages;
}

Result<std::vector<EdgeMap>> RunStages::Detect(const Scene& scene) {
  const Stopwatch stopwatch;
  const Options& options = record_.settings.options;
  Result<std::vector<EdgeMap>> edge_maps =
      LoadOrMake(kDetectEdges, EdgesKey(scene, options), [&] {
        return DetectEdges(scene, options, progress_.Callback());
      });
  if (edge_maps.ok()) FinishEdges(stopwatch, *edge_maps);
  return edge_maps;
}

std::vector<EdgeMap> RunStages::Link(std::vector<EdgeMap> edge_maps) {
  const Stopwatch stopwatch;
  for (EdgeMap& map : edge_maps) {
    map.neighbors =
        LinkNeighbors(map.edges, record_.settings.options.edge_detection);
  }
  FinishEdges(stopwatch, edge_maps);
  return edge_maps;
}

void RunStages::FinishEdges(const Stopwatch& stopwatch,
                            const std::vector<EdgeMap>& edge_maps) {
  StageCounts counts = CountEdges(edge_maps);
  record_.result.num_edges_2d = counts.front().second;
  counts.insert(counts.begin(), {"views", record_.input.num_views});
  std::string text = CountsText(counts);
  FinishStage(stopwatch.Read(kDetectEdges.name, std::move(counts)),
              std::move(text));
}

Status RunStages::RefinePoses(const ColmapModel& model, SceneStages& stages) {
  const Stopwatch stopwatch;
  const Options& options = record_.settings.options;
  const bool refine_intrinsics = record_.settings.poses.refine_intrinsics;
  Scene& scene = stages.scene;
  Result<CurvePoses> refined =
      LoadOrMake(kRefinePosesWithCurves,
                 CurvePosesKey(scene, options, refine_intrinsics),
                 [&] {
                   return RefinePosesWithCurves(scene,
                                                stages.edge_maps,
                                                options,
                                                progress_.Callback(),
                                                refine_intrinsics);
                 });
  if (!refined.ok()) return refined.status();
  CurvePoseRefinement result =
      ModelWithCurvePoses(model, scene, *std::move(refined));
  record_.curve_poses = result.record;
  FinishStage(stopwatch.Read(kRefinePosesWithCurves.name),
              CurvePosesText(result.record));
  const std::string refusal = CurvePosesRefusal(result.record);
  if (!refusal.empty()) progress_.Note(refusal);
  if (!result.model) return {};
  const CurvePoses& poses = result.record.poses;
  CURVIX_ASSIGN_OR_RETURN(
      stages.edge_maps,
      EdgesWithCameras(scene, std::move(stages.edge_maps), poses.cameras));
  stages.refined_model = std::move(result.model);
  MoveViews(poses, &scene);
  std::map<std::uint64_t, Eigen::Vector3d> positions;
  for (const ColmapPoint3D& point : stages.refined_model->points) {
    positions[point.point3D_id] = point.position;
  }
  for (ScenePoint& point : scene.points) {
    point.position = positions.at(point.point3D_id);
  }
  return {};
}

Result<EdgeSketch> RunStages::Sketch(const Scene& scene,
                                     const std::vector<EdgeMap>& edge_maps) {
  const Stopwatch stopwatch;
  const Options& options = record_.settings.options;
  Result<EdgeSketch> sketch =
      LoadOrMake(kSketchEdges, SketchKey(scene, options), [&] {
        return SketchEdges(scene, edge_maps, options, progress_.Callback());
      });
  if (!sketch.ok()) return sketch;
  record_.result.edge_sigma_px = sketch->edge_sigma_px;
  FinishStage(stopwatch.Read(kSketchEdges.name, CountsOf(*sketch)),
              RepeatedViewsText(sketch->counts.repeated_views));
  return sketch;
}

void RunStages::FinishStage(StageReport report, std::string text) {
  const std::vector<std::string>& resumed = record_.resumed_stages;
  if (!resumed.empty() && resumed.back() == report.name) {
    text += std::string(text.empty() ? "" : ", ") + "as an earlier run left it";
  }
  progress_.Finish(text);
  record_.stages.push_back(std::move(report));
}

Status RunStages::KeptStages(Status status) const {
  if (status.code() != StatusCode::kCancelled || !store_.has_saved()) {
    return status;
  }
  return {status.code(),
          "Interrupted; no results were written, but finished stages are kept: "
          "the same command goes on from there"};
}

Result<Reconstruction> RunStages::Reconstruct(
    const Scene& scene, const std::vector<EdgeMap>& edge_maps) {
  CURVIX_ASSIGN_OR_RETURN(const EdgeSketch sketch, Sketch(scene, edge_maps));
  CURVIX_ASSIGN_OR_RETURN(Reconstruction reconstruction,
                          CurvesFromSketch(scene,
                                           edge_maps,
                                           sketch,
                                           record_.settings.options,
                                           progress_.Callback()));
  progress_.Finish("");
  for (const StageReport& stage : reconstruction.report.stages) {
    record_.stages.push_back(stage);
  }
  return reconstruction;
}

}  // namespace curvix
