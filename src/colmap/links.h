// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Links that others may have put into a workspace.
#pragma once

#include <filesystem>
#include <vector>

namespace curvix {

// Whether `path` is `folder` or below it, by their names alone.
bool IsInside(const std::filesystem::path& path,
              const std::filesystem::path& folder);

// Whether `path`, all links followed, lies in one of the `folders`, all links
// followed. What does not exist lies in its parent folder.
bool LiesIn(const std::filesystem::path& path,
            const std::vector<std::filesystem::path>& folders);

}  // namespace curvix
