// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/python/python_progress.h"

namespace curvix {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kBetweenCalls(50);

// Names come from files and may hold any bytes.
py::str Text(const std::string& text) {
  return py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(
      text.data(), static_cast<py::ssize_t>(text.size()), "backslashreplace"));
}

}  // namespace

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
    is_cancelled_ = answer.is(py::bool_(false));
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
