// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/python/python_errors.h"

#include <array>
#include <cstddef>
#include <exception>
#include <stdexcept>

namespace curvix {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kBetweenCalls(50);

// Names come from files and may hold any bytes.
py::str Text(const std::string& text) {
  return py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(
      text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace"));
}

struct ErrorClass {
  const char* name;
  const char* base;  // among Python's own
  const char* doc;
};

// In the order of StatusCode, from kInvalidArgument on.
constexpr std::array kClasses = {
    ErrorClass{"ArgumentError",
               "ValueError",
               "An option or an argument that cannot work."},
    ErrorClass{
        "NotFoundError",
        "FileNotFoundError",
        "A file, folder or program that is not there or cannot be opened."},
    ErrorClass{"DataError",
               "OSError",
               "A file that is broken, truncated or cannot be written."},
    ErrorClass{"UnsupportedError",
               "ValueError",
               "Valid input that curvix does not handle."},
    ErrorClass{
        "ToolError", "RuntimeError", "A program that was called failed."},
    ErrorClass{"CancelledError",
               "RuntimeError",
               "The progress function returned False."},
    ErrorClass{"InternalError",
               "RuntimeError",
               "A mistake of curvix itself; please report it."}};
static_assert(kClasses.size() ==
              static_cast<std::size_t>(StatusCode::kInternal));

// Not objects of C++, which would be destroyed after Python has ended.
std::array<PyObject*, kClasses.size()> classes = {};

PyObject* NewClass(const std::string& name,
                   const char* doc,
                   const py::object& bases) {
  PyObject* const made = PyErr_NewExceptionWithDoc(
      ("pycurvix." + name).c_str(), doc, bases.ptr(), nullptr);
  if (made == nullptr) throw py::error_already_set();
  return made;
}

// `status` is not ok.
void Set(const Status& status) {
  PyErr_SetObject(classes.at(static_cast<std::size_t>(status.code()) - 1),
                  Text(status.message()).ptr());
}

}  // namespace

void Raise(const Status& status) {
  Set(status);
  throw py::error_already_set();
}

void BindErrors(py::module_& module) {
  const auto error = py::reinterpret_steal<py::object>(
      NewClass("Error",
               "What curvix cannot do, and why, in a sentence.",
               py::reinterpret_borrow<py::object>(PyExc_Exception)));
  module.attr("Error") = error;
  const py::module_ builtins = py::module_::import("builtins");
  for (std::size_t i = 0; i < kClasses.size(); ++i) {
    classes[i] =
        NewClass(kClasses[i].name,
                 kClasses[i].doc,
                 py::make_tuple(error, builtins.attr(kClasses[i].base)));
    module.attr(kClasses[i].name) = py::handle(classes[i]);
  }
  // What CURVIX_CHECK throws.
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const std::logic_error& broken) {
      Set(Status::Internal(broken.what()));
    }
  });
}

// f(), with Python's lock; what it raises stops the run.
template <typename F>
void PythonProgress::Guard(const F& f) {
  const py::gil_scoped_acquire acquired;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    f();
  } catch (py::error_already_set& error) {
    raised_.emplace(std::move(error));
    is_cancelled_ = true;
  }
}

void PythonProgress::Call(const std::string& stage, int done, int total) {
  Guard([&] {
    if (callback_.is_none()) return;
    const py::object answer = callback_(stage, done, total);
    is_cancelled_ = !answer.is_none() && !py::bool_(answer);
  });
}

bool PythonProgress::Update(const std::string& stage, int done, int total) {
  if (is_cancelled_) return false;
  const Clock::time_point now = Clock::now();
  const bool is_end = total > 0 && done == total;
  if (stage == stage_ && !is_end && now - last_call_ < kBetweenCalls) {
    return true;
  }
  stage_ = stage;
  last_call_ = now;
  Call(stage, done, total);
  return !is_cancelled_;
}

void PythonProgress::Note(const std::string& line) {
  Guard([&] {
    // Whoever handles records has imported logging. To others it shows
    // warnings like this, but its import nearly doubles Python's start.
    if (!py::module_::import("sys").attr("modules").contains("logging")) {
      PySys_FormatStderr("%U\n", Text(line).ptr());
      return;
    }
    py::module_::import("logging")
        .attr("getLogger")("pycurvix")
        .attr("warning")("%s", Text(line));
  });
}

bool PythonProgress::IsCancelled() {
  if (!is_cancelled_) Guard([] {});
  return is_cancelled_;
}

}  // namespace curvix
