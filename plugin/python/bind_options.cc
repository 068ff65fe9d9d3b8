// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>
#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/option_table.h"
#include "plugin/base/suggestion.h"
#include "plugin/commands/commands.h"
#include "plugin/python/bindings.h"
#include "plugin/python/python_errors.h"

namespace curvix {
namespace {

namespace py = pybind11;

// Those of `reconstruct`, without paths of a workspace, in the order in which
// they are set. Their defaults are the values that `settings` has.
std::vector<Flag> FlagsOf(RunSettings& settings) {
  std::vector<Flag> flags;
  const std::vector<Flag> paths = PathsSection(&settings).flags;
  for (FlagSection& section : ReconstructSections(&settings)) {
    for (Flag& flag : section.flags) {
      const bool is_path = std::ranges::any_of(
          paths, [&](const Flag& path) { return path.name == flag.name; });
      if (!is_path) flags.push_back(std::move(flag));
    }
  }
  return flags;
}

Flag FlagNamed(const std::string& name, RunSettings& settings) {
  std::vector<std::string> names;
  for (Flag& flag : FlagsOf(settings)) {
    if (flag.name == name) return flag;
    names.push_back(flag.name);
  }
  Raise(Status::InvalidArgument(
      "There is no option '" + name + "'" +
      Suggestion(name, names, "", "list(pycurvix.Options()) has all")));
}

py::object ValueOf(const Flag& flag) {
  if (!flag.row) return py::str(flag.default_value);
  return std::visit(
      [&](const auto* field) -> py::object {
        using Value = std::remove_cv_t<std::remove_pointer_t<decltype(field)>>;
        if constexpr (std::is_arithmetic_v<Value>) {
          return py::cast(*field);
        } else {
          return py::str(ValueText(*flag.row));
        }
      },
      flag.row->field);
}

py::dict About(const Flag& flag) {
  py::dict about;
  about["name"] = flag.name;
  about["help"] = flag.help;
  about["range"] = flag.range;
  about["unit"] = flag.unit;
  about["symbol"] = flag.symbol;
  about["default"] = ValueOf(flag);
  return about;
}

// With all that was set before, as if on one command line: a preset changes
// nothing that was ever given. Nothing is set if one cannot be.
void SetAll(PythonOptions& options,
            const std::vector<std::pair<std::string, std::string>>& values) {
  PythonOptions changed{{}, options.given};
  for (const auto& [name, text] : values) {
    FlagNamed(name, changed.settings);
    changed.given[name] = text;
  }
  for (const Flag& flag : FlagsOf(changed.settings)) {
    const auto value = changed.given.find(flag.name);
    if (value != changed.given.end()) Check(flag.set(value->second));
  }
  options = std::move(changed);
}

}  // namespace

void BindOptions(py::module_& module) {
  py::class_<PythonOptions>(module, "Options")
      .def(py::init<>())
      .def("names",
           [](PythonOptions& options) {
             std::vector<std::string> names;
             for (const Flag& flag : FlagsOf(options.settings)) {
               names.push_back(flag.name);
             }
             return names;
           })
      .def("get",
           [](PythonOptions& options, const std::string& name) {
             return ValueOf(FlagNamed(name, options.settings));
           })
      .def("set", SetAll)
      .def_readonly("given", &PythonOptions::given)
      .def_static("about", [](const std::string& name) {
        RunSettings settings;
        return About(FlagNamed(name, settings));
      });
}

}  // namespace curvix
