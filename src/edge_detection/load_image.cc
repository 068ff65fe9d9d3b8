// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Image files to grey levels.
#include "edge_detection/load_image.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "edge_detection/image_header.h"

namespace curvix {
namespace {

using Bytes = std::vector<std::uint8_t>;

Result<Bytes> ReadFile(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status file =
      std::filesystem::status(path, error);
  if (!std::filesystem::exists(file)) {
    return Status(StatusCode::kNotFound,
                  "Image " + path.string() +
                      " does not exist. Check the folder of images.");
  }
  if (!std::filesystem::is_regular_file(file)) {
    return Status(
        StatusCode::kNotFound,
        "Image " + path.string() + " is a folder or a device, not a file.");
  }
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream.tellg();
  Bytes bytes(size > 0 ? static_cast<std::size_t>(size) : 0);
  stream.seekg(0);
  stream.read(reinterpret_cast<char*>(bytes.data()), size);
  if (!stream) {
    return Status(
        StatusCode::kNotFound,
        "Image " + path.string() + " cannot be read. Check its permissions.");
  }
  if (bytes.empty()) {
    return Status(
        StatusCode::kDataLoss,
        "Image " + path.string() + " is an empty file. Copy it again.");
  }
  return bytes;
}

// Grey of the values of a pixel in OpenCV's order: grey; B, G, R; B, G, R,
// alpha.
template <int kChannels, typename T>
float Grey(const T* value) {
  constexpr double kMax = std::numeric_limits<T>::max();
  if constexpr (kChannels == 1) {
    return static_cast<float>(value[0] * (255 / kMax));
  } else {
    const double grey = 0.114 * value[0] + 0.587 * value[1] + 0.299 * value[2];
    if constexpr (kChannels == 3) {
      return static_cast<float>(grey * (255 / kMax));
    } else {
      return static_cast<float>(grey * (value[3] / kMax) * (255 / kMax));
    }
  }
}

template <int kChannels, typename T>
GrayImage ToGrey(const cv::Mat& image) {
  GrayImage gray{image.cols, image.rows, std::vector<float>(image.total())};
  float* pixels = gray.pixels.data();
  for (int y = 0; y < image.rows; ++y, pixels += image.cols) {
    const T* value = image.ptr<T>(y);
    for (int x = 0; x < image.cols; ++x) {
      pixels[x] = Grey<kChannels>(value + kChannels * x);
    }
  }
  return gray;
}

// nullopt: another number of channels.
template <typename T>
std::optional<GrayImage> ToGrey(const cv::Mat& image) {
  switch (image.channels()) {
    case 1:
      return ToGrey<1, T>(image);
    case 3:
      return ToGrey<3, T>(image);
    case 4:
      return ToGrey<4, T>(image);
    default:
      return std::nullopt;
  }
}

// Empty if it is no image, or if there is not enough memory for it.
cv::Mat Decode(const Bytes& bytes) {
  try {
    // Unchanged: alpha kept, depth kept, EXIF rotation ignored.
    return cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    return {};
  }
}

std::string_view AsText(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Status WrongSize(const std::filesystem::path& path,
                 const ImageSize& size,
                 const ImageSize& expected) {
  std::ostringstream message;
  message << "Image " << path.string() << " is " << size.width << " x "
          << size.height << " pixels, but its camera in the model is "
          << expected.width << " x " << expected.height
          << ". Give the images from which the model was made, or export the "
             "model at the size of these images.";
  return {StatusCode::kInvalidArgument, message.str()};
}

Status Broken(const std::filesystem::path& path, const Bytes& bytes) {
  if (IsHeif(AsText(bytes))) {
    return {StatusCode::kUnsupported,
            "Image " + path.string() +
                " is HEIF or AVIF, which is not read here. Convert all images "
                "to JPEG or PNG, and make the model of these."};
  }
  return {StatusCode::kDataLoss,
          "Image " + path.string() +
              " is broken, cut short or in an unknown format. Copy it "
              "again, or convert it to PNG or JPEG."};
}

}  // namespace

Result<ImageSize> ReadImageSize(const std::filesystem::path& path) {
  const Result<Bytes> bytes = ReadFile(path);
  if (!bytes.ok()) return bytes.status();
  if (const auto size = SizeInHeader(AsText(*bytes))) return *size;
  const cv::Mat image = Decode(*bytes);
  if (image.empty()) return Broken(path, *bytes);
  return ImageSize{image.cols, image.rows};
}

Result<GrayImage> LoadGrayImage(const std::filesystem::path& path,
                                const std::optional<ImageSize>& expected) {
  const Result<Bytes> bytes = ReadFile(path);
  if (!bytes.ok()) return bytes.status();
  const std::optional<ImageSize> announced = SizeInHeader(AsText(*bytes));
  if (expected && announced && *announced != *expected) {
    return WrongSize(path, *announced, *expected);
  }
  const cv::Mat image = Decode(*bytes);
  if (image.empty() || IsTruncatedJpeg(AsText(*bytes)))
    return Broken(path, *bytes);
  const ImageSize size = {image.cols, image.rows};
  if (expected && size != *expected) return WrongSize(path, size, *expected);
  std::optional<GrayImage> gray;
  if (image.depth() == CV_8U) gray = ToGrey<std::uint8_t>(image);
  if (image.depth() == CV_16U) gray = ToGrey<std::uint16_t>(image);
  if (gray) return *std::move(gray);
  return Status(StatusCode::kUnsupported,
                "Image " + path.string() +
                    " has neither 8 nor 16 bits per channel, or an unusual "
                    "number of channels. Convert it to an 8-bit PNG.");
}

}  // namespace curvix
