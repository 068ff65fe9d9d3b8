// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Image files to grey levels.
#include "edge_detection/load_image.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
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
  std::ifstream stream(path, std::ios::binary);
  Bytes bytes{std::istreambuf_iterator<char>(stream),
              std::istreambuf_iterator<char>()};
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

// Grey of `channels` values in OpenCV's order: grey; B, G, R; B, G, R, alpha.
template <typename T>
float Grey(const T* value, int channels) {
  constexpr double kMax = std::numeric_limits<T>::max();
  if (channels == 1) return static_cast<float>(value[0] * (255 / kMax));
  const double grey = 0.114 * value[0] + 0.587 * value[1] + 0.299 * value[2];
  const double alpha = channels == 4 ? value[3] / kMax : 1.0;
  return static_cast<float>(grey * alpha * (255 / kMax));
}

template <typename T>
GrayImage ToGrey(const cv::Mat& image) {
  GrayImage gray{image.cols, image.rows, {}};
  gray.pixels.reserve(image.total());
  const int channels = image.channels();
  for (int y = 0; y < image.rows; ++y) {
    const T* value = image.ptr<T>(y);
    for (int x = 0; x < image.cols; ++x, value += channels) {
      gray.pixels.push_back(Grey(value, channels));
    }
  }
  return gray;
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

Status Broken(const std::filesystem::path& path) {
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
  if (image.empty()) return Broken(path);
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
  if (image.empty() || IsTruncatedJpeg(AsText(*bytes))) return Broken(path);
  const ImageSize size = {image.cols, image.rows};
  if (expected && size != *expected) return WrongSize(path, size, *expected);
  const int channels = image.channels();
  if (channels == 1 || channels == 3 || channels == 4) {
    if (image.depth() == CV_8U) return ToGrey<std::uint8_t>(image);
    if (image.depth() == CV_16U) return ToGrey<std::uint16_t>(image);
  }
  return Status(StatusCode::kUnsupported,
                "Image " + path.string() +
                    " has neither 8 nor 16 bits per channel, or an unusual "
                    "number of channels. Convert it to an 8-bit PNG.");
}

}  // namespace curvix
