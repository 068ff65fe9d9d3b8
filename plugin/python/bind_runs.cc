// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/edges.h>
#include <curvix/reconstruct.h>
#include <curvix/refine_poses.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <utility>
#include <vector>

#include "base/option_table.h"
#include "base/stopwatch.h"
#include "colmap/colmap_model.h"
#include "edge_detection/curvelets.h"
#include "measuring/moved_curves.h"
#include "plugin/base/progress.h"
#include "plugin/commands/evaluations.h"
#include "plugin/poses/curve_poses.h"
#include "plugin/python/bindings.h"
#include "plugin/python/python_errors.h"
#include "plugin/run/run_stages.h"
#include "plugin/run/run_workspace.h"

namespace curvix {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

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
  CurvePoseRefinement refined = ModelWithCurvePoses(
      ModelOfScene(run_.scene), run_.scene, *std::move(poses));
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

// The stages of RunWorkspace behind bundle adjustment, which is for models of
// COLMAP: edges, unless `edges` has them, one map per view, whose neighbours
// are looked for as among detected ones; poses refined with curves, if
// settings.poses says so; curves and fits. Nothing is written. Errors as
// ReconstructCurves.
Result<WorkspaceRun> ReconstructScene(const Scene& scene,
                                      const std::vector<EdgeMap>* edges,
                                      const RunSettings& settings,
                                      RunProgress& progress) {
  return SceneJob(scene, settings, progress).Run(edges);
}

RunSettings SettingsOf(const PythonOptions& options,
                       const WorkspacePaths& paths) {
  Check(Validate(options.settings.options));
  RunSettings settings = options.settings;
  static_cast<WorkspacePaths&>(settings) = paths;
  return settings;
}

// In the frame of alignment.json, if there is one, as the files are.
void MoveToWorld(WorkspaceRun& run) {
  if (!run.record.alignment) return;
  const Similarity3& world_from_model = run.record.alignment->world_from_model;
  run.scene = MoveScene(world_from_model, std::move(run.scene));
  for (Curve& curve : run.curves.curves) {
    curve = MoveCurve(world_from_model, std::move(curve));
  }
  for (CurveJunction& junction : run.curves.junctions) {
    junction.position = world_from_model * junction.position;
    junction.sigma *= world_from_model.scale;
  }
  run.fitted = MoveFits(world_from_model, std::move(run.fitted));
}

std::unique_ptr<PythonCurves> CurvesOf(WorkspaceRun run) {
  return WithoutLock([&] {
    MoveToWorld(run);
    // Writers ask for edges, not for their neighbours.
    for (EdgeMap& map : run.edge_maps) map.neighbors = {};
    auto curves = std::make_unique<PythonCurves>(
        std::move(run.curves),
        std::make_shared<const Scene>(std::move(run.scene)),
        std::make_shared<const std::vector<EdgeMap>>(std::move(run.edge_maps)),
        run.record.settings.options.curve_fitting);
    curves->set_fits(std::move(run.fitted));
    curves->set_report(ReportJson(run.record));
    curves->set_alignment(std::move(run.record.alignment));
    return curves;
  });
}

std::unique_ptr<PythonCurves> ReconstructWorkspace(const WorkspacePaths& paths,
                                                   const PythonOptions& options,
                                                   const py::object& callback) {
  const RunSettings settings = SettingsOf(options, paths);
  return CurvesOf(RunWithProgress(callback, [&](RunProgress& progress) {
    return RunWorkspace(settings, progress);
  }));
}

std::unique_ptr<PythonCurves> Reconstruct(const PythonScene& scene,
                                          const PythonOptions& options,
                                          const py::object& callback) {
  const RunSettings settings = SettingsOf(options, {});
  return CurvesOf(RunWithProgress(callback, [&](RunProgress& progress) {
    return ReconstructScene(
        *scene.scene, scene.edge_maps.get(), settings, progress);
  }));
}

// One JSON object.
std::string EvaluateHoldout(const WorkspacePaths& paths,
                            const fs::path& curves_path,
                            int every,
                            const PythonOptions& options,
                            const py::object& callback) {
  const RunSettings settings = SettingsOf(options, paths);
  return RunWithProgress(callback,
                         [&](RunProgress& progress) -> Result<std::string> {
                           std::ostringstream json;
                           Status status = RunHoldout(settings,
                                                      curves_path,
                                                      every,
                                                      EvaluationFormat::kJson,
                                                      progress,
                                                      json);
                           if (!status.ok()) return status;
                           return json.str();
                         });
}

}  // namespace

void BindRuns(py::module_& module) {
  py::class_<WorkspacePaths>(module, "Paths")
      .def(py::init<fs::path, fs::path, fs::path, fs::path, fs::path>());
  module.def("reconstruct_workspace", ReconstructWorkspace);
  module.def("reconstruct_scene", Reconstruct);
  module.def("evaluate_holdout", EvaluateHoldout);
}

}  // namespace curvix
