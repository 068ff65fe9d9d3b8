// SPDX-License-Identifier: BSD-3-Clause
// The files that `colmap_curvix draw` has written, by their content: others of
// their names are the user's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace curvix {

// The files of the drawing `name`, relative to `folder`. None if <name>.svg is
// not as `draw` wrote it: another program has saved it.
std::vector<std::filesystem::path> FilesOfDrawing(
    const std::filesystem::path& folder, const std::string& name);

// The files of all drawings in `folder`, relative to it.
std::vector<std::filesystem::path> FilesOfDrawings(
    const std::filesystem::path& folder);

}  // namespace curvix
