// SPDX-License-Identifier: BSD-3-Clause
// What the module pycurvix._core holds. Its users are the files of
// plugin/python/pycurvix/, which document it for everyone else.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/fitting.h>
#include <curvix/scene.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "measuring/world_alignment.h"
#include "plugin/python/curve_table.h"
#include "plugin/run/run_report.h"

namespace curvix {

// Views, and their edges if they did not come as images.
struct PythonScene {
  std::shared_ptr<const Scene> scene;
  SharedEdges edge_maps;  // without neighbours; null: there are images
};

// The options of a run, without its paths.
struct PythonOptions {
  RunSettings settings;
  std::map<std::string, std::string> given = {};  // what was set, by name
};

// Curves and what is known about them.
class PythonCurves {
 public:
  PythonCurves(CurveSet curves,
               std::shared_ptr<const Scene> from_scene,
               SharedEdges edge_maps,
               const CurveFittingOptions& options = {})
      : table(std::move(curves), std::move(edge_maps)),
        scene(std::move(from_scene)),
        options_(options) {}

  // Fitted at the first call, unless they were given. For any thread, without
  // Python's lock.
  const FitTable& Fits() const;
  void set_fits(FittedCurves fitted) { fits_.emplace(std::move(fitted)); }

  // These curves, with their fits if there are any yet.
  std::unique_ptr<PythonCurves> Select(
      const std::vector<std::size_t>& ids) const;

  const CurveTable table;
  const std::shared_ptr<const Scene> scene;  // null: not known
  std::string report;                        // "": not made by a run
  std::optional<WorldAlignment> alignment;   // none: the frame is the model's

 private:
  const CurveFittingOptions options_;
  mutable std::mutex mutex_;  // of fits_
  mutable std::optional<FitTable> fits_;
};

// An array that shows `items` without copying: of each item its first numbers
// of type `Number`, in an array of shape `item_shape`, a matrix by columns as
// Eigen has it. It is read only and keeps `owner`, which holds the items.
template <typename Number, typename T>
pybind11::array ViewOf(const pybind11::object& owner,
                       const std::vector<T>& items,
                       const std::vector<pybind11::ssize_t>& item_shape) {
  std::vector<pybind11::ssize_t> shape = {
      static_cast<pybind11::ssize_t>(items.size())};
  std::vector<pybind11::ssize_t> strides = {sizeof(T)};
  pybind11::ssize_t step = sizeof(Number);
  for (const pybind11::ssize_t length : item_shape) {
    shape.push_back(length);
    strides.push_back(step);
    step *= length;
  }
  static const T none = {};  // a null pointer would mean a new array
  pybind11::array view(pybind11::dtype::of<Number>(),
                       shape,
                       strides,
                       items.empty() ? &none : items.data(),
                       owner);
  view.attr("setflags")(pybind11::arg("write") = false);
  return view;
}

void BindOptions(pybind11::module_& module);
void BindScene(pybind11::module_& module);
void BindCurves(pybind11::module_& module);
void BindCurveFiles(pybind11::module_& module);
void BindRuns(pybind11::module_& module);

}  // namespace curvix
