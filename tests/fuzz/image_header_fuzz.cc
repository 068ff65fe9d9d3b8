// SPDX-License-Identifier: BSD-3-Clause
// What image files say about themselves. Decoders are OpenCV's.
#include "base/image_header.h"

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/fuzz/fuzz_target.h"

namespace curvix {

std::vector<std::string> FuzzSeeds() {
  std::vector<std::string> seeds;
  for (const char* extension : {".png", ".jpg", ".tiff", ".bmp", ".ppm"}) {
    std::vector<unsigned char> bytes;
    cv::imencode(extension, cv::Mat(9, 7, CV_8UC3, cv::Scalar(1, 2, 3)), bytes);
    seeds.emplace_back(bytes.begin(), bytes.end());
    const auto header = HeaderOf(seeds.back());
    Require(header && header->size == ImageSize{7, 9}, "sizes are found");
  }
  return seeds;
}

void FuzzReader(std::string_view bytes) {
  IsTruncatedJpeg(bytes);
  std::vector<std::uint8_t> tiff(bytes.begin(), bytes.end());
  IgnoreTiffOrientation(&tiff);
  const std::optional<ImageHeader> header = HeaderOf(bytes);
  Require(!header || (header->size.width > 0 && header->size.height > 0),
          "sizes are positive");
}

}  // namespace curvix
