// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>
#include <array>
#include <mutex>
#include <utility>

#include "plugin/python/bindings.h"
#include "plugin/python/python_errors.h"

namespace curvix {

namespace py = pybind11;

const FitTable& PythonCurves::Fits() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!fits_) {
    const Scene none;
    fits_.emplace(
        FitCurves(table, scene == nullptr ? none : *scene, options_, 0));
  }
  return *fits_;
}

std::unique_ptr<PythonCurves> PythonCurves::Select(
    const std::vector<std::size_t>& ids) const {
  auto selected = std::make_unique<PythonCurves>(
      table.Select(ids), scene, table.edge_maps(), options_);
  selected->alignment = alignment;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (fits_) selected->set_fits(SelectFits(fits_->fitted, ids));
  return selected;
}

namespace {

// A getter of ViewOf() a column.
template <typename Number, typename Column>
auto Viewer(const Column& column, std::vector<py::ssize_t> item_shape = {}) {
  return [column, item_shape](const py::object& self) {
    return ViewOf<Number>(
        self, column(self.cast<const PythonCurves&>()), item_shape);
  };
}

template <typename Number, typename T>
auto ViewerOf(std::vector<T> CurveColumns::*column,
              std::vector<py::ssize_t> item_shape = {}) {
  return Viewer<Number>(
      [column](const PythonCurves& curves) -> const std::vector<T>& {
        return curves.table.columns().*column;
      },
      std::move(item_shape));
}

template <typename Number, typename T>
auto FitViewerOf(std::vector<T> FitTable::*column,
                 std::vector<py::ssize_t> item_shape = {}) {
  return Viewer<Number>(
      [column](const PythonCurves& curves) -> const std::vector<T>& {
        return WithoutLock([&]() -> const FitTable* {
                 return &curves.Fits();
               })->*column;
      },
      std::move(item_shape));
}

std::vector<double> LengthsOf(const PythonCurves& curves) {
  std::vector<double> lengths;
  curves.table.ForEach([&](std::size_t, const Curve& curve) {
    lengths.push_back(Length(curve));
  });
  return lengths;
}

const View& ViewAt(const Scene& scene, std::size_t view_idx) {
  if (view_idx >= scene.views.size()) {
    Raise(Status::InvalidArgument("there is no view " +
                                  std::to_string(view_idx)));
  }
  return scene.views[view_idx];
}

// Of each curve the parts that the view could see.
std::vector<std::vector<py::array_t<double>>> ProjectAll(
    const PythonCurves& curves,
    const PythonScene& scene,
    std::size_t view_idx) {
  using Segments = std::vector<std::vector<Eigen::Vector2d>>;
  const View& view = ViewAt(*scene.scene, view_idx);
  const Camera& camera = CameraOf(*scene.scene, view);
  std::vector<Segments> projected;
  WithoutLock([&] {
    curves.table.ForEach([&](std::size_t, const Curve& curve) {
      projected.push_back(ProjectCurve(curve, view, camera));
    });
  });
  std::vector<std::vector<py::array_t<double>>> arrays(projected.size());
  for (std::size_t i = 0; i < projected.size(); ++i) {
    for (const std::vector<Eigen::Vector2d>& segment : projected[i]) {
      arrays[i].emplace_back(
          std::array<py::ssize_t, 2>{static_cast<py::ssize_t>(segment.size()),
                                     2},
          segment.front().data());
    }
  }
  return arrays;
}

std::unique_ptr<PythonCurves> Select(const PythonCurves& curves,
                                     const std::vector<std::size_t>& ids) {
  for (const std::size_t id : ids) {
    if (id >= curves.table.size()) {
      Raise(Status::InvalidArgument("there is no curve " + std::to_string(id)));
    }
  }
  return WithoutLock([&] { return curves.Select(ids); });
}

using Class = py::class_<PythonCurves>;

void BindColumns(Class& curves) {
  using C = CurveColumns;
  const auto add = [&](const char* name, const auto& column) {
    curves.def_property_readonly(name, column);
  };
  add("offsets", ViewerOf<std::int64_t>(&C::sample_offsets));
  add("closed", ViewerOf<bool>(&C::closed));
  add("start_junction", ViewerOf<std::int32_t>(&C::start_junction));
  add("end_junction", ViewerOf<std::int32_t>(&C::end_junction));
  add("positions", ViewerOf<double>(&C::positions, {3}));
  add("tangents", ViewerOf<double>(&C::tangents, {3}));
  add("covariances", ViewerOf<double>(&C::covariances, {3, 3}));
  add("sigmas", ViewerOf<double>(&C::sigmas));
  add("evidence", ViewerOf<double>(&C::evidence));
  add("kinds", ViewerOf<std::uint8_t>(&C::kinds));
  add("kind_probabilities", ViewerOf<float>(&C::kind_probabilities));
  add("support_offsets", ViewerOf<std::int64_t>(&C::support_offsets));
  add("support", ViewerOf<std::int32_t>(&C::support, {2}));
  add("junctions", [](const py::object& self) {
    const auto& junctions = self.cast<const PythonCurves&>().table.junctions();
    return ViewOf<double>(self, junctions, {3});
  });
}

// Tells NumPy, which takes long to import, of the rows when they are asked for.
void DescribeFitRows() {
  static std::once_flag once;
  const py::gil_scoped_release released;
  std::call_once(once, [] {
    const py::gil_scoped_acquire locked;
    PYBIND11_NUMPY_DTYPE(FitRow,
                         curve,
                         kind,
                         closed,
                         first_sample,
                         num_samples,
                         length,
                         start,
                         end,
                         start_node,
                         end_node,
                         radius,
                         center,
                         major,
                         minor,
                         start_angle,
                         end_angle,
                         first_point,
                         num_points,
                         first_knot,
                         rms_residual,
                         max_residual,
                         inlier_share,
                         sigma,
                         radius_sigma);
  });
}

void BindFits(Class& curves) {
  using F = FitTable;
  const auto add = [&](const char* name, const auto& column) {
    curves.def_property_readonly(name, column);
  };
  add("fits", [](const py::object& self) {
    DescribeFitRows();
    return FitViewerOf<FitRow>(&F::rows)(self);
  });
  add("fit_offsets", FitViewerOf<std::int64_t>(&F::fit_offsets));
  add("spline_points", FitViewerOf<double>(&F::spline_points, {3}));
  add("spline_knots", FitViewerOf<double>(&F::spline_knots));
  add("nodes", FitViewerOf<double>(&F::nodes, {3}));
  add("node_covariances", FitViewerOf<double>(&F::node_covariances, {3, 3}));
}

}  // namespace

void BindCurves(py::module_& module) {
  static_assert(sizeof(EdgeRef) == 2 * sizeof(std::int32_t));
  static_assert(sizeof(CurveKind) == 1);
  Class curves(module, "Curves");
  BindColumns(curves);
  BindFits(curves);
  curves
      .def("__len__",
           [](const PythonCurves& self) { return self.table.size(); })
      .def("scene",
           [](const PythonCurves& self) -> std::optional<PythonScene> {
             if (self.scene == nullptr) return std::nullopt;
             return PythonScene{self.scene, nullptr};
           })
      .def("report", [](const PythonCurves& self) { return self.report; })
      .def("lengths",
           [](const PythonCurves& self) {
             return WithoutLock([&] { return LengthsOf(self); });
           })
      .def("select", Select)
      .def("project", ProjectAll);

  std::vector<std::string> kinds;
  for (int kind = 0; kind <= static_cast<int>(CurveKind::kOccludingContour);
       ++kind) {
    kinds.emplace_back(KindName(static_cast<CurveKind>(kind)));
  }
  module.attr("CURVE_KINDS") = kinds;
  std::vector<std::string> fit_kinds;
  for (int kind = 0; kind <= static_cast<int>(FitKind::kSpline); ++kind) {
    CurveFit fit;
    fit.kind = static_cast<FitKind>(kind);
    fit_kinds.emplace_back(KindName(fit));
  }
  module.attr("FIT_KINDS") = fit_kinds;
}

}  // namespace curvix
