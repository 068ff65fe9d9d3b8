// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/edges.h>
#include <curvix/reconstruct.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/option_table.h"
#include "base/stopwatch.h"
#include "colmap/colmap_model.h"
#include "measuring/moved_curves.h"
#include "plugin/base/progress.h"
#include "plugin/commands/evaluations.h"
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

// The stages of RunWorkspace behind bundle adjustment, which is for models of
// COLMAP, as RunStages::Run() does them, and fits. Nothing is written.
Result<WorkspaceRun> ReconstructScene(Scene scene,
                                      const std::vector<EdgeMap>* edges,
                                      const RunSettings& settings,
                                      RunProgress& progress) {
  const Stopwatch since_start;
  WorkspaceRun run;
  RunRecord& record = run.record;
  record = SceneRecord(scene, settings);
  const ColmapModel model = ModelOfScene(scene);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    scene.points[i].point3D_id = model.points[i].point3D_id;
  }
  CURVIX_ASSIGN_OR_RETURN(
      run.stages,
      RunStages({}, progress, record).Run(model, std::move(scene), edges));
  const Reconstruction& reconstruction = run.stages.reconstruction;
  const CurvesInMemory curves(reconstruction.curves, &run.stages.edge_maps);
  run.fitted = FitCurvesOf(run.stages.scene, curves, record);
  for (const Curve& curve : reconstruction.curves.curves) {
    Count(curve, record.result);
  }
  record.result.num_edges_3d =
      static_cast<std::int64_t>(reconstruction.edges.size());
  record.result.why_empty = reconstruction.report.why_empty;
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
  run.stages.scene = MoveScene(world_from_model, std::move(run.stages.scene));
  CurveSet& curves = run.stages.reconstruction.curves;
  for (Curve& curve : curves.curves) {
    curve = MoveCurve(world_from_model, std::move(curve));
  }
  for (CurveJunction& junction : curves.junctions) {
    junction.position = world_from_model * junction.position;
    junction.sigma *= world_from_model.scale;
  }
  run.fitted = MoveFits(world_from_model, std::move(run.fitted));
}

std::unique_ptr<PythonCurves> CurvesOf(WorkspaceRun run) {
  return WithoutLock([&] {
    MoveToWorld(run);
    // Writers ask for edges, not for their neighbours.
    auto& [scene, edge_maps, refined, reconstruction] = run.stages;
    for (EdgeMap& map : edge_maps) map.neighbors = {};
    auto curves = std::make_unique<PythonCurves>(
        std::move(reconstruction.curves),
        std::make_shared<const Scene>(std::move(scene)),
        std::make_shared<const std::vector<EdgeMap>>(std::move(edge_maps)),
        run.record.settings.options.curve_fitting);
    curves->set_fits(std::move(run.fitted));
    curves->report = ReportJson(run.record);
    curves->alignment = std::move(run.record.alignment);
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
  return RunWithProgress(callback, [&](RunProgress& progress) {
    return RunHoldout(settings, curves_path, every, /*json=*/true, progress);
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
