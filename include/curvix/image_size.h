// SPDX-License-Identifier: BSD-3-Clause
// The size of an image without decoding it.
#pragma once

#include <curvix/status.h>

#include <filesystem>

namespace curvix {

struct ImageSize {
  int width = 0;   // pixels
  int height = 0;  // pixels

  friend bool operator==(const ImageSize& a, const ImageSize& b) {
    return a.width == b.width && a.height == b.height;
  }
};

// The size of the image as stored (an EXIF rotation is ignored, as COLMAP
// does): from the header of PNG, JPEG and TIFF files, by decoding others.
// kNotFound: no such file. kDataLoss: not an image.
Result<ImageSize> ReadImageSize(const std::filesystem::path& path);

}  // namespace curvix
