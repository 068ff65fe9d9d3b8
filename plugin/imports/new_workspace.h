// SPDX-License-Identifier: BSD-3-Clause
// Writes a COLMAP workspace, whole or not at all.
#pragma once

#include <curvix/status.h>
#include <filesystem>
#include <vector>

#include "colmap/colmap_model.h"

namespace curvix {

// How images get into a workspace; the names are COLMAP's.
enum class CopyPolicy { kCopy, kSoftLink, kHardLink };

// Writes `model` to <workspace>/sparse/0, binary, and its images, which are
// `image_files` in the order of model.images, to <workspace>/images. Both are
// made in a temporary folder inside the workspace and moved into place
// together; a failure leaves everything as it was, folders that were made for
// it included. Images that are the files in <workspace>/images already stay
// there.
// kInvalidArgument if <workspace>/sparse or, but for such images,
// <workspace>/images holds anything, or if something cannot be written. A hard
// link cannot lead to another file system, a soft link breaks if its original
// is moved.
Status WriteNewWorkspace(const ColmapModel& model,
                         const std::vector<std::filesystem::path>& image_files,
                         CopyPolicy policy,
                         const std::filesystem::path& workspace);

// kInvalidArgument if `path` is there and is not an empty folder.
Status CheckUnused(const std::filesystem::path& path);

// As WriteNewWorkspace fails when the workspace is in use: to be asked before
// long work.
Status CheckWorkspaceUnused(const std::filesystem::path& workspace);

}  // namespace curvix
