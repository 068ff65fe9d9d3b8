// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/python/reconstruct_scene.h"

#include <curvix/reconstruct.h>
#include <curvix/refine_poses.h>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/stopwatch.h"
#include "colmap/colmap_model.h"
#include "edge_detection/curvelets.h"
#include "plugin/poses/curve_poses.h"
#include "plugin/run/run_stages.h"

namespace curvix {
namespace {

// The scene as COLMAP would have it. The id of a camera or a point is its index
// and one.
ColmapModel ModelOf(const Scene& scene) {
  ColmapModel model;
  for (const Camera& camera : scene.cameras) {
    const auto id = static_cast<std::uint32_t>(model.cameras.size() + 1);
    model.cameras.push_back({id, camera});
  }
  for (const View& view : scene.views) {
    model.images.push_back({view.image_id,
                            view.cam_from_world,
                            static_cast<std::uint32_t>(view.camera_idx + 1),
                            view.name,
                            {}});
  }
  for (const ScenePoint& point : scene.points) {
    ColmapPoint3D made;
    made.point3D_id = model.points.size() + 1;
    made.position = point.position;
    for (std::size_t i = 0; i < point.pixels.size(); ++i) {
      if (!point.pixels[i].allFinite()) continue;
      ColmapImage& image =
          model.images[static_cast<std::size_t>(point.view_idxs[i])];
      made.track.push_back(
          {image.image_id, static_cast<std::uint32_t>(image.points2D.size())});
      image.points2D.push_back(
          {point.pixels[i].x(), point.pixels[i].y(), made.point3D_id});
    }
    model.points.push_back(std::move(made));
  }
  return model;
}

class SceneJob {
 public:
  SceneJob(const Scene& scene,
           const RunSettings& settings,
           RunProgress& progress)
      : progress_(progress) {
    run_.scene = scene;
    run_.record.settings = settings;
    run_.record.settings.poses.refiner = "none";
  }

  Result<WorkspaceRun> Run(const std::vector<EdgeMap>* edges);

 private:
  Status FindEdges(const std::vector<EdgeMap>* edges);
  Status RefinePoses();
  void Summarize(const Reconstruction& reconstruction);

  const Options& options() const { return run_.record.settings.options; }

  RunProgress& progress_;
  Stopwatch since_start_;
  WorkspaceRun run_;
};

Status SceneJob::FindEdges(const std::vector<EdgeMap>* edges) {
  const Stopwatch stopwatch;
  if (edges == nullptr) {
    auto detected = DetectEdges(run_.scene, options(), progress_.Callback());
    if (!detected.ok()) return detected.status();
    run_.edge_maps = *std::move(detected);
  } else {
    run_.edge_maps = *edges;
    for (EdgeMap& map : run_.edge_maps) {
      map.neighbors = LinkNeighbors(map.edges, options().edge_detection);
    }
  }
  RunRecord& record = run_.record;
  record.stages.push_back(stopwatch.Read("detect_edges"));
  record.stages.back().counts = CountEdges(run_.edge_maps);
  record.result.num_edges_2d = record.stages.back().counts.front().second;
  return {};
}

Status SceneJob::RefinePoses() {
  const Stopwatch stopwatch;
  const PoseRefinementSettings& settings = run_.record.settings.poses;
  if (!settings.refine_poses_with_curves) return {};
  Result<CurvePoses> poses = RefinePosesWithCurves(run_.scene,
                                                   run_.edge_maps,
                                                   options(),
                                                   progress_.Callback(),
                                                   settings.refine_intrinsics);
  if (!poses.ok()) return poses.status();
  run_.record.stages.push_back(stopwatch.Read("refine_poses_with_curves"));
  auto moved =
      EdgesWithCameras(run_.scene, std::move(run_.edge_maps), poses->cameras);
  if (!moved.ok()) return moved.status();
  run_.edge_maps = *std::move(moved);
  CurvePoseRefinement refined =
      ModelWithCurvePoses(ModelOf(run_.scene), run_.scene, *std::move(poses));
  const CurvePoses& accepted = refined.record.poses;
  run_.scene.cameras = accepted.cameras;
  for (std::size_t i = 0; i < run_.scene.views.size(); ++i) {
    run_.scene.views[i].cam_from_world = accepted.cam_from_world[i];
  }
  if (refined.model) {
    for (const ColmapPoint3D& point : refined.model->points) {
      run_.scene.points[point.point3D_id - 1].position = point.position;
    }
  }
  run_.record.curve_poses = std::move(refined.record);
  return {};
}

void SceneJob::Summarize(const Reconstruction& reconstruction) {
  RunRecord& record = run_.record;
  for (const Camera& camera : run_.scene.cameras) {
    record.input.camera_models.emplace_back(ModelName(camera.model));
  }
  record.input.num_views = static_cast<std::int64_t>(run_.scene.views.size());
  record.input.num_points = static_cast<std::int64_t>(run_.scene.points.size());
  const std::int64_t num_edges_2d = record.result.num_edges_2d;
  record.result = SummarizeCurves(run_.curves);
  record.result.num_edges_2d = num_edges_2d;
  record.result.num_edges_3d =
      static_cast<std::int64_t>(reconstruction.edges.size());
  record.result.why_empty = reconstruction.report.why_empty;
  record.total = since_start_.Read("total");
}

Result<WorkspaceRun> SceneJob::Run(const std::vector<EdgeMap>* edges) {
  Status status = FindEdges(edges);
  if (status.ok()) status = RefinePoses();
  if (!status.ok()) return status;
  Result<Reconstruction> found = ReconstructCurves(
      run_.scene, run_.edge_maps, options(), progress_.Callback());
  if (!found.ok()) return found.status();
  for (StageReport& stage : found->report.stages) {
    run_.record.stages.push_back(stage);
  }
  run_.curves = std::move(found->curves);
  const Stopwatch stopwatch;
  run_.fitted = FitCurves(CurvesInMemory(run_.curves, &run_.edge_maps),
                          run_.scene,
                          options().curve_fitting,
                          options().runtime.num_threads);
  run_.record.stages.push_back(stopwatch.Read("fit_curves"));
  run_.record.stages.back().counts = CountFits(run_.fitted);
  Summarize(*found);
  return std::move(run_);
}

}  // namespace

Result<WorkspaceRun> ReconstructScene(const Scene& scene,
                                      const std::vector<EdgeMap>* edges,
                                      const RunSettings& settings,
                                      RunProgress& progress) {
  return SceneJob(scene, settings, progress).Run(edges);
}

}  // namespace curvix
