// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Files and folders of workspaces, into which others
// may have put links.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace curvix {

// Whether `path` is `folder` or below it, by their names alone.
bool IsInside(const std::filesystem::path& path,
              const std::filesystem::path& folder);

// Whether `path`, all links followed, lies in one of the `folders`, all links
// followed. What does not exist lies in its parent folder.
bool LiesIn(const std::filesystem::path& path,
            const std::vector<std::filesystem::path>& folders);

// Whether there is a file or a folder, links followed; false on errors.
inline bool IsFile(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}
inline bool IsFolder(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

// Whether rights keep it from being known if `path` is there.
inline bool IsForbidden(const std::filesystem::path& path) {
  std::error_code error;
  return !std::filesystem::exists(path, error) &&
         error == std::errc::permission_denied;
}

// Sorted; empty on errors.
std::vector<std::filesystem::path> EntriesOf(
    const std::filesystem::path& folder);

// "a, b, c, d, e and 12 more": at most five.
std::string FirstNames(const std::vector<std::string>& names);

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
  std::ranges::replace(name, '\\', '/');
  return folder / name;
}

}  // namespace curvix
