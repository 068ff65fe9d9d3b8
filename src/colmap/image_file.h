// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Names of images to files.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>

namespace curvix {

// The file in `folder` that `name`, relative to it, means: that of this name,
// or, if there is none, the one with slashes for the backslashes of Windows.
inline std::filesystem::path ImageFile(const std::filesystem::path& folder,
                                       std::string name) {
  std::filesystem::path file = folder / name;
  std::error_code error;
  if (name.find('\\') == std::string::npos ||
      std::filesystem::exists(file, error)) {
    return file;
  }
  std::replace(name.begin(), name.end(), '\\', '/');
  return folder / name;
}

}  // namespace curvix
