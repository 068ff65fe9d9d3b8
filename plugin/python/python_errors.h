// SPDX-License-Identifier: BSD-3-Clause
// Failures as Python's exceptions, long work without Python's lock, and its
// progress.
#pragma once

#include <curvix/status.h>
#include <pybind11/pybind11.h>
#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "plugin/base/file_errors.h"
#include "plugin/base/progress.h"

namespace curvix {

// Raises pycurvix.Error, or rather what fits of its subclasses, with the
// sentence of `status`, which is not ok. Python's lock is held.
[[noreturn]] void Raise(const Status& status);

// Adds these classes to the module.
void BindErrors(pybind11::module_& module);

inline void Check(const Status& status) {
  if (!status.ok()) Raise(status);
}

template <typename T>
T Take(Result<T> result) {
  if (!result.ok()) Raise(result.status());
  return *std::move(result);
}

// f(), while other threads of Python run. It may not touch what is Python's.
template <typename F>
auto WithoutLock(const F& f) {
  const pybind11::gil_scoped_release released;
  return f();
}

// Made and destroyed with Python's lock, used without by one thread.
class PythonProgress : public RunProgress {
 public:
  // `callback(stage, done, total)`, or None. The run stops when it returns
  // False or raises. It is called at the start and at the end of each stage,
  // and in between at most twenty times a second; as often, signals are looked
  // for.
  explicit PythonProgress(pybind11::object callback)
      : callback_(std::move(callback)) {}

  bool Update(const std::string& stage, int done, int total) override;
  void Finish(const std::string& /*detail*/) override {}
  // To the logger "pycurvix", as a warning.
  void Note(const std::string& line) override;
  bool IsCancelled() override;

  // What was raised while a run went on: Ctrl-C, or by the callback.
  void RaiseWhatStopped() {
    if (raised_) throw *std::exchange(raised_, std::nullopt);
  }

 private:
  using Clock = std::chrono::steady_clock;

  template <typename F>
  void Guard(const F& f);
  void Call(const std::string& stage, int done, int total);

  pybind11::object callback_;
  std::string stage_;
  Clock::time_point last_call_ = {};
  bool is_cancelled_ = false;
  std::optional<pybind11::error_already_set> raised_;
};

// The value of `run(progress)`, which works without Python's lock; kNotFound if
// the file system throws.
template <typename F>
auto RunWithProgress(const pybind11::object& callback, const F& run) {
  PythonProgress progress(callback);
  auto result = WithoutLock(
      [&] { return CatchFileErrors([&] { return run(progress); }); });
  progress.RaiseWhatStopped();
  return Take(std::move(result));
}

}  // namespace curvix
