// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "plugin/image_size.h"

#include <array>
#include <cstddef>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>

namespace curvix {
namespace {

// Big endian numbers from a file; a failed read leaves the stream failed.
unsigned Take(std::istream& file, int num_bytes) {
  unsigned value = 0;
  for (int i = 0; i < num_bytes; ++i) {
    value = value << 8 | (static_cast<unsigned>(file.get()) & 0xffu);
  }
  return value;
}

std::optional<ImageSize> Checked(const std::istream& file,
                                 unsigned width,
                                 unsigned height) {
  constexpr unsigned kMax = 1u << 20;
  if (!file || width == 0 || height == 0 || width > kMax || height > kMax) {
    return std::nullopt;
  }
  return ImageSize{static_cast<int>(width), static_cast<int>(height)};
}

// The stream is behind the signature.
std::optional<ImageSize> SizeOfPng(std::istream& file) {
  file.seekg(16);
  const unsigned width = Take(file, 4);
  return Checked(file, width, Take(file, 4));
}

// Walks over the segments to the start of a frame (SOF). The stream is behind
// the signature.
std::optional<ImageSize> SizeOfJpeg(std::istream& file) {
  file.seekg(2);
  while (file) {
    if (Take(file, 1) != 0xff) return std::nullopt;
    unsigned marker = Take(file, 1);
    while (file && marker == 0xff) marker = Take(file, 1);
    const bool is_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 &&
                          marker != 0xc8 && marker != 0xcc;
    const unsigned length = Take(file, 2);
    if (length < 2) return std::nullopt;
    if (is_frame) {
      Take(file, 1);  // bits per sample
      const unsigned height = Take(file, 2);
      return Checked(file, Take(file, 2), height);
    }
    file.seekg(length - 2, std::ios::cur);
  }
  return std::nullopt;
}

std::optional<ImageSize> SizeByDecoding(const std::filesystem::path& path) {
  try {
    const cv::Mat image = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
    if (image.empty()) return std::nullopt;
    return ImageSize{image.cols, image.rows};
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
}

}  // namespace

Result<ImageSize> ReadImageSize(const std::filesystem::path& path) {
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  if (!file || !std::filesystem::is_regular_file(path, ignored)) {
    return Status(StatusCode::kNotFound,
                  path.string() + " is not a file that can be read.");
  }
  std::string start(8, '\0');
  file.read(start.data(), 8);
  std::optional<ImageSize> size;
  if (start == "\x89PNG\r\n\x1a\n") {
    size = SizeOfPng(file);
  } else if (start.starts_with("\xff\xd8")) {
    size = SizeOfJpeg(file);
  } else {
    size = SizeByDecoding(path);
  }
  if (size) return *size;
  return Status(StatusCode::kDataLoss,
                path.string() +
                    " is not an image, or it is damaged; copy it "
                    "again or remove it.");
}

}  // namespace curvix
