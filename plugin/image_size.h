// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The size of an image without decoding it.
#pragma once

#include <curvix/status.h>

#include <filesystem>

namespace curvix {

struct ImageSize {
  int width = 0;   // pixels
  int height = 0;  // pixels

  bool operator==(const ImageSize&) const = default;
};

// The size of the image as stored (an EXIF rotation is ignored, as COLMAP
// does): from the header of PNG and JPEG files, by decoding others.
// kNotFound: no such file. kDataLoss: not an image.
Result<ImageSize> ReadImageSize(const std::filesystem::path& path);

}  // namespace curvix
