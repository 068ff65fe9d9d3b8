// SPDX-License-Identifier: BSD-3-Clause
// The files that `colmap_curvix draw` has written, by their content: others of
// their names are the user's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace curvix {

// Those of the drawing `name` in `folder`: paths in it. None if <name>.svg is
// not one of ours, as it is not once another program has saved it.
std::vector<std::filesystem::path> FilesOfDrawing(
    const std::filesystem::path& folder, const std::string& name);

// Those of all drawings in `folder`.
std::vector<std::filesystem::path> FilesOfDrawings(
    const std::filesystem::path& folder);

}  // namespace curvix
