// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <filesystem>
#include <sstream>
#include <utility>

#include "base/option_table.h"
#include "plugin/commands/evaluate_holdout.h"
#include "plugin/python/bindings.h"
#include "plugin/python/python_progress.h"
#include "plugin/python/reconstruct_scene.h"
#include "plugin/run/run_workspace.h"

namespace curvix {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

struct Paths {
  fs::path workspace_path;
  fs::path input_path;
  fs::path image_path;
  fs::path output_path;
  fs::path mask_path;
};

RunSettings SettingsOf(const PythonOptions& options, const Paths& paths) {
  Check(Validate(options.settings.options));
  RunSettings settings = options.settings;
  settings.workspace_path = paths.workspace_path;
  settings.input_path = paths.input_path;
  settings.image_path = paths.image_path;
  settings.output_path = paths.output_path;
  settings.mask_path = paths.mask_path;
  return settings;
}

std::unique_ptr<PythonCurves> CurvesOf(WorkspaceRun run) {
  return WithoutLock([&] {
    // Writers ask for edges, not for their neighbours.
    for (EdgeMap& map : run.edge_maps) map.neighbors = {};
    auto curves = std::make_unique<PythonCurves>(
        std::move(run.curves),
        std::make_shared<const Scene>(std::move(run.scene)),
        std::make_shared<const std::vector<EdgeMap>>(std::move(run.edge_maps)),
        run.record.settings.options.curve_fitting);
    curves->set_fits(std::move(run.fitted));
    curves->set_report(ReportJson(run.record));
    return curves;
  });
}

std::unique_ptr<PythonCurves> ReconstructWorkspace(const Paths& paths,
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
std::string EvaluateHoldout(const Paths& paths,
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
  py::class_<Paths>(module, "Paths")
      .def(py::init<fs::path, fs::path, fs::path, fs::path, fs::path>());
  module.def("reconstruct_workspace", ReconstructWorkspace);
  module.def("reconstruct_scene", Reconstruct);
  module.def("evaluate_holdout", EvaluateHoldout);
}

}  // namespace curvix
