// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/curve_io.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <filesystem>
#include <string>

#include "base/file_io.h"
#include "evaluation/evaluate.h"
#include "plugin/commands/evaluations.h"
#include "plugin/export/write_results.h"
#include "plugin/python/bindings.h"
#include "plugin/python/python_errors.h"

namespace curvix {
namespace {

namespace py = pybind11;
namespace fs = std::filesystem;

std::unique_ptr<PythonCurves> Read(const fs::path& path,
                                   const PythonScene* scene) {
  const Scene none;
  CurveSet curves = Take(WithoutLock([&] {
    return ReadCurves(path, scene == nullptr ? none : *scene->scene);
  }));
  return WithoutLock([&] {
    return std::make_unique<PythonCurves>(
        std::move(curves), scene == nullptr ? nullptr : scene->scene, nullptr);
  });
}

void Write(const PythonCurves& curves,
           const fs::path& path,
           const std::string& format,
           const std::string& svg_image) {
  OutputSettings settings;
  settings.svg_image = svg_image;
  const bool needs_scene = format == "json" || format == "html" ||
                           format == "svg" || format == "colmap";
  if (needs_scene && curves.scene == nullptr) {
    Raise(Status::InvalidArgument("format '" + format +
                                  "' shows the curves with their views; read "
                                  "them with pycurvix.read(path, scene)"));
  }
  // The others are written as what the path says.
  const bool has_any_ending =
      format == "csv" || format == "colmap" || needs_scene;
  if (!has_any_ending && ExtensionOf(path) != "." + format) {
    Raise(Status::InvalidArgument("format '" + format +
                                  "' needs a path that ends in ." + format));
  }
  Check(WithoutLock([&] {
    const Scene none;
    const FittedCurves no_fits;
    const bool needs_fits = format == "json" || format == "html" ||
                            format == "dxf" || format == "step" ||
                            format == "csv";
    return WriteFormat({curves.scene == nullptr ? none : *curves.scene,
                        curves.table,
                        needs_fits ? curves.Fits().fitted : no_fits,
                        curves.alignment ? &*curves.alignment : nullptr},
                       settings,
                       0,
                       format,
                       path);
  }));
}

// One JSON object.
std::string Evaluate(const PythonCurves& curves,
                     const fs::path& truth_path,
                     double unit_mm,
                     double step,
                     int min_num_views) {
  EvaluationOptions options;
  options.unit_mm = unit_mm;
  options.step = step;
  options.min_num_views = min_num_views;
  const auto evaluate = [&]() -> Result<Evaluation> {
    CURVIX_ASSIGN_OR_RETURN(const GroundTruth truth,
                            ReadGroundTruth(truth_path));
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < curves.table.size(); ++i) all.push_back(i);
    return EvaluateCurves(curves.table.Select(all), truth, options);
  };
  return EvaluationText(Take(WithoutLock(evaluate)), /*json=*/true);
}

}  // namespace

void BindCurveFiles(py::module_& module) {
  module.def("read", Read);
  module.def("write", Write);
  module.def("evaluate", Evaluate);
  std::vector<std::pair<std::string, std::string>> formats;
  for (const OutputFormat& format : OutputFormats()) {
    formats.emplace_back(format.name, format.file);
  }
  module.attr("FORMATS") = formats;
}

}  // namespace curvix
