// SPDX-License-Identifier: BSD-3-Clause
// Scenes that are not part of this repository. Tests that need them are skipped
// where they are not.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace curvix {

// $CURVIX_DATA, else ../shared/data beside the source tree.
inline std::filesystem::path DataFolder() {
  const char* const data = std::getenv("CURVIX_DATA");
  if (data != nullptr) return data;
  return std::filesystem::path(CURVIX_SOURCE_DIR) / "../shared/data";
}

}  // namespace curvix
