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
#include "measuring/moved_curves.h"
#include "plugin/base/progress.h"
#include "plugin/commands/evaluations.h"
#include "plugin/poses/curve_poses.h"
#include "plugin/python/bindings.h"
#include "plugin/python/python_errors.h"
#include "plugin/run/run_stages.h"
#include "plugin/run/run_steps.h"
#include "plugin/run/run_workspace.h"

namespace curvix {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

// The record of a run on `scene`.
RunRecord SceneRecord(const Scene& scene, const RunSettings& settings) {
  RunRecord record;
  record.settings = settings;
  record.settings.poses.refiner = "none";
  for (const Camera& camera : scene.cameras) {
    record.input.camera_models.emplace_back(ModelName(camera.model));
  }
  record.input.num_views = static_cast<std::int64_t>(scene.views.size());
  record.input.num_points = static_cast<std::int64_t>(scene.points.size());
  return record;
}

// Refines the poses of `run` with curves.
Status RefineScenePoses(RunStages& stages, WorkspaceRun& run) {
  Scene& scene = run.scene;
  const auto refined =
      stages.RefinePosesWithCurves(ModelOfScene(scene), scene, run.edge_maps);
  if (!refined.ok()) return refined.status();
  if (!refined->model) return {};
  const CurvePoses& poses = refined->record.poses;
  auto moved = EdgesWithCameras(scene, std::move(run.edge_maps), poses.cameras);
  if (!moved.ok()) return moved.status();
  run.edge_maps = *std::move(moved);
  scene.cameras = poses.cameras;
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    scene.views[i].cam_from_world = poses.cam_from_world[i];
  }
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    scene.points[i].position = refined->model->points[i].position;
  }
  return {};
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
  const Stopwatch since_start;
  WorkspaceRun run;
  run.record = SceneRecord(scene, settings);
  run.scene = scene;
  RunRecord& record = run.record;
  RunStages stages({}, progress, record);
  Result<std::vector<EdgeMap>> edge_maps =
      edges == nullptr ? stages.Detect(scene) : stages.Link(*edges);
  if (!edge_maps.ok()) return edge_maps.status();
  run.edge_maps = *std::move(edge_maps);
  if (settings.poses.refine_poses_with_curves) {
    Status status = RefineScenePoses(stages, run);
    if (!status.ok()) return status;
  }
  Result<Reconstruction> found = stages.Reconstruct(run.scene, run.edge_maps);
  if (!found.ok()) return found.status();
  run.curves = std::move(found->curves);
  run.fitted = FitCurvesOf(
      run.scene, CurvesInMemory(run.curves, &run.edge_maps), record);
  for (const Curve& curve : run.curves.curves) Count(curve, record.result);
  record.result.num_edges_3d = static_cast<std::int64_t>(found->edges.size());
  record.result.why_empty = found->report.why_empty;
  record.total = since_start.Read("total");
  return run;
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
