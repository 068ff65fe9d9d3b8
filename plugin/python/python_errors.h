// SPDX-License-Identifier: BSD-3-Clause
// Failures as Python's exceptions, and long work without Python's lock.
#pragma once

#include <curvix/status.h>
#include <pybind11/pybind11.h>
#include <utility>

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

}  // namespace curvix
