// SPDX-License-Identifier: BSD-3-Clause
// Writes a COLMAP workspace, whole or not at all.
#pragma once

#include <curvix/status.h>
#include <filesystem>
#include <functional>
#include <string>
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
// <workspace>/images holds anything. kInvalidArgument, kNotFound or kDataLoss
// if an image cannot be read or something cannot be written. A hard link cannot
// lead to another file system, a soft link breaks if its original is moved.
// kCancelled if keep_going, which is asked after each image, returns false.
Status WriteNewWorkspace(const ColmapModel& model,
                         const std::vector<std::filesystem::path>& image_files,
                         CopyPolicy policy,
                         const std::filesystem::path& workspace,
                         const std::function<bool()>& keep_going = {});

// Moves the files and folders `names` from one folder to another, all or none.
// Empty folders in their places go.
Status MoveIntoWorkspace(const std::vector<std::string>& names,
                         const std::filesystem::path& from,
                         const std::filesystem::path& to);

// kInvalidArgument if `path` is there and is not an empty folder: to be asked
// before long work.
Status CheckUnused(const std::filesystem::path& path);

}  // namespace curvix
