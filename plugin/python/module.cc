// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/python/bindings.h"
#include "plugin/python/python_errors.h"

PYBIND11_MODULE(_core, module) {
  module.doc() = "The compiled part of pycurvix.";
  module.attr("__version__") = std::string(curvix::ProgramVersion());
  curvix::BindErrors(module);
  curvix::BindOptions(module);
  curvix::BindScene(module);
  curvix::BindCurves(module);
  curvix::BindCurveFiles(module);
  curvix::BindRuns(module);
}
