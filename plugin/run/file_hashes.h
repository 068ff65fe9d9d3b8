// SPDX-License-Identifier: BSD-3-Clause
// By which it is known whether the files behind a result are still the same:
// hashes of their bytes, alike on every machine, whatever the folders and the
// times of the files. No file is held in memory.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "plugin/base/progress.h"

namespace curvix {

// Of the image and the mask of each view. kNotFound if one cannot be opened,
// kDataLoss if one cannot be read; kCancelled.
Result<std::vector<std::uint64_t>> HashImages(const Scene& scene,
                                              int num_threads,
                                              RunProgress& progress);

// Of such hashes.
std::uint64_t HashOf(const std::vector<std::uint64_t>& hashes);

// Of cameras, images and points in the folder of a COLMAP model, in the format
// in which it is read.
Result<std::uint64_t> HashModel(const std::filesystem::path& folder);

}  // namespace curvix
