// SPDX-License-Identifier: BSD-3-Clause
// Exceptions of the file system as statuses.
#pragma once

#include <curvix/status.h>
#include <filesystem>

namespace curvix {

// f(), a Status or a Result; kNotFound with the system's reason if it throws
// std::filesystem::filesystem_error.
template <typename F>
auto CatchFileErrors(const F& f) -> decltype(f()) {
  try {
    return f();
  } catch (const std::filesystem::filesystem_error& error) {
    return Status::NotFound(error.what());
  }
}

}  // namespace curvix
