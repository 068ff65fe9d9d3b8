// SPDX-License-Identifier: BSD-3-Clause
#include "colmap/files.h"

#include <cstdint>

#include "base/count_text.h"

namespace curvix {

namespace fs = std::filesystem;

bool IsInside(const fs::path& path, const fs::path& folder) {
  const auto ends =
      std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return ends.first == folder.end();
}

bool LiesIn(const fs::path& path, const std::vector<fs::path>& folders) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  if (error) return false;
  return std::ranges::any_of(folders, [&](const fs::path& folder) {
    const fs::path root = fs::canonical(folder, error);
    return !error && IsInside(real, root);
  });
}

std::vector<fs::path> EntriesOf(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    entries.push_back(entry->path());
  }
  std::ranges::sort(entries);
  return entries;
}

std::string FirstNames(const std::vector<std::string>& names) {
  constexpr std::size_t kMany = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMany); ++i) {
    text += (i > 0 ? ", " : "") + names[i];
  }
  if (names.size() <= kMany) return text;
  return text + " and " +
         GroupDigits(static_cast<std::int64_t>(names.size() - kMany)) + " more";
}

}  // namespace curvix
