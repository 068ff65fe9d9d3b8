// SPDX-License-Identifier: BSD-3-Clause
// The files of this repository, for tests that read them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace curvix {

// Paths below the root, with '/', "src/base/check.h" say. Sorted. Build folders
// and hidden ones are left out.
inline std::vector<std::string> FilesBelow(
    const std::vector<std::string>& folders,
    const std::vector<std::string>& extensions) {
  namespace fs = std::filesystem;
  const fs::path root = CURVIX_SOURCE_DIR;
  std::vector<std::string> files;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (entry.is_regular_file() &&
          std::ranges::find(extensions, extension) != extensions.end()) {
        files.push_back(entry.path().lexically_relative(root).generic_string());
      }
    }
  }
  std::ranges::sort(files);
  return files;
}

// The whole of a file below the root; empty if there is none.
inline std::string ReadSource(const std::string& name) {
  std::ifstream file(std::filesystem::path(CURVIX_SOURCE_DIR) / name,
                     std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::vector<std::string> Lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline bool ExistsInTree(const std::string& name) {
  return std::filesystem::exists(std::filesystem::path(CURVIX_SOURCE_DIR) /
                                 name);
}

}  // namespace curvix
