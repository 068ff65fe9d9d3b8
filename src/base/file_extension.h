// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#pragma once

#include <filesystem>
#include <string>

namespace curvix {

// In lower case: ".obj" of a/B.OBJ.
inline std::string ExtensionOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace curvix
