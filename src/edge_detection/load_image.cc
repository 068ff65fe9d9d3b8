// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/load_image.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "base/file_io.h"

namespace curvix {
namespace {

// `name`: as messages begin, "Image a.png" or "Mask a.png.png".
Result<std::string> ReadImageFile(const std::filesystem::path& path,
                                  const std::string& name) {
  std::error_code error;
  const std::filesystem::file_status file =
      std::filesystem::status(path, error);
  if (!std::filesystem::exists(file)) {
    return Status::NotFound(name + " does not exist. Check its folder.");
  }
  if (!std::filesystem::is_regular_file(file)) {
    return Status::NotFound(name + " is a folder or a device, not a file.");
  }
  Result<std::string> bytes = ReadFile(path);
  if (bytes.ok() && bytes->empty()) {
    return Status::DataLoss(name + " is an empty file. Copy it again.");
  }
  return bytes;
}

// Grey of values without gaps: grey ones; or three colours, of which number
// `red` is red and 2 - `red` blue, and perhaps alpha; up to max_value. nullopt:
// another number of channels.
template <typename T>
std::optional<GrayImage> ToGrey(const T* values,
                                const ImageSize& size,
                                int num_channels,
                                int red,
                                double max_value) {
  if (num_channels != 1 && num_channels != 3 && num_channels != 4) {
    return std::nullopt;
  }
  const std::size_t num_pixels = static_cast<std::size_t>(size.width) *
                                 static_cast<std::size_t>(size.height);
  GrayImage gray{size.width, size.height, std::vector<float>(num_pixels)};
  for (float& pixel : gray.pixels) {
    double grey = values[0];
    if (num_channels > 1) {
      grey = 0.114 * values[2 - red] + 0.587 * values[1] + 0.299 * values[red];
    }
    if (num_channels == 4) grey *= values[3] / max_value;
    pixel = static_cast<float>(grey * (255 / max_value));
    values += num_channels;
  }
  return gray;
}

// Of what OpenCV decoded of a file with this header; nullopt: another kind of
// pixels.
std::optional<GrayImage> ToGrey(const cv::Mat& image,
                                const std::optional<ImageHeader>& header) {
  constexpr int kRed = 2;
  const ImageSize size = {image.cols, image.rows};
  if (image.depth() == CV_8U) {
    return ToGrey(image.ptr<std::uint8_t>(), size, image.channels(), kRed, 255);
  }
  if (image.depth() == CV_16U) {
    const int max_value = header ? header->max_value : 0;
    return ToGrey(image.ptr<std::uint16_t>(),
                  size,
                  image.channels(),
                  kRed,
                  max_value > 0 ? max_value : 65535);
  }
  return std::nullopt;
}

// Empty if it is no image, or if there is not enough memory for it.
cv::Mat Decode(const std::string& file) {
  try {
    std::vector<std::uint8_t> bytes(file.begin(), file.end());
    IgnoreTiffOrientation(&bytes);
    // Unchanged: alpha kept, depth kept, EXIF rotation ignored.
    return cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    return {};
  }
}

Status WrongSize(const std::string& name,
                 const ImageSize& size,
                 const ImageSize& expected) {
  const bool is_turned = size == ImageSize{expected.height, expected.width};
  return Status::InvalidArgument(
      name + " is " + SizeText(size) +
      " pixels, but its camera in the model is " + SizeText(expected) +
      (is_turned ? ". Images are taken as they are stored, as COLMAP does, "
                   "whatever the orientation in their EXIF data."
                 : ".") +
      " Give the images from which the model was made, or export the model at "
      "the size of these images.");
}

Status WrongShape(const std::string& name,
                  const ImageSize& size,
                  const ImageSize& expected) {
  return Status::InvalidArgument(
      name + " is " + SizeText(size) + " pixels, and its image " +
      SizeText(expected) +
      ". A mask may be larger or smaller than its image, but has the same "
      "shape.");
}

Status Broken(const std::string& name, const std::string& bytes) {
  if (IsHeif(bytes)) {
    return Status::Unsupported(
        name +
        " is HEIF or AVIF, which is not read here. Convert all images "
        "to JPEG or PNG, and make the model of these.");
  }
  return Status::DataLoss(
      name +
      " is broken, cut short or in an unknown format. Copy it "
      "again, or convert it to PNG or JPEG.");
}

Status WrongPixels(const std::string& name) {
  return Status::Unsupported(
      name +
      " has neither 8 nor 16 bits per channel, or an unusual number of "
      "channels. Convert it to an 8-bit PNG.");
}

// `check(size)` is OK for the sizes that will do.
template <typename CheckSize>
Result<GrayImage> LoadFile(const std::filesystem::path& path,
                           const std::string& name,
                           const CheckSize& check) {
  CURVIX_ASSIGN_OR_RETURN(const std::string bytes, ReadImageFile(path, name));
  const std::optional<ImageHeader> header = HeaderOf(bytes);
  if (header) {
    CURVIX_RETURN_IF_ERROR(check(header->size));
  }
  const cv::Mat image = Decode(bytes);
  if (image.empty() || IsTruncatedJpeg(bytes)) return Broken(name, bytes);
  CURVIX_RETURN_IF_ERROR(check(ImageSize{image.cols, image.rows}));
  if (std::optional<GrayImage> gray = ToGrey(image, header))
    return *std::move(gray);
  return WrongPixels(name);
}

// What LoadFile would say, as far as the header tells.
template <typename CheckSize>
Status CheckFile(const std::filesystem::path& path,
                 const std::string& name,
                 const CheckSize& check) {
  constexpr int kMaxBits = 16;
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(path, error);
  if (const auto header = is_file ? ReadImageHeader(path) : std::nullopt) {
    Status status = check(header->size);
    if (status.ok() && header->bits_per_channel > kMaxBits) {
      return WrongPixels(name);
    }
    return status;
  }
  if (is_file && cv::haveImageReader(path.string())) return {};
  const Result<std::string> bytes = ReadImageFile(path, name);
  return bytes.ok() ? Broken(name, *bytes) : bytes.status();
}

// For LoadFile and CheckFile: `expected` and no other size.
auto IsOfSize(const std::string& name, const ImageSize& expected) {
  return [=](const ImageSize& size) {
    return size == expected ? Status() : WrongSize(name, size, expected);
  };
}

// Any size of the shape of `expected`.
auto IsOfShape(const std::string& name, const ImageSize& expected) {
  return [=](const ImageSize& size) {
    return HaveSameShape(size, expected) ? Status()
                                         : WrongShape(name, size, expected);
  };
}

GrayImage Resized(GrayImage image, const ImageSize& size) {
  const cv::Mat from(image.height, image.width, CV_32F, image.pixels.data());
  cv::Mat1f to;
  cv::resize(from,
             to,
             cv::Size(size.width, size.height),
             0,
             0,
             cv::INTER_NEAREST_EXACT);
  return {size.width, size.height, std::vector<float>(to.begin(), to.end())};
}

}  // namespace

Result<ImageSize> ReadImageSize(const std::filesystem::path& path) {
  const std::string name = "Image " + path.string();
  CURVIX_ASSIGN_OR_RETURN(const std::string bytes, ReadImageFile(path, name));
  if (const auto header = HeaderOf(bytes)) return header->size;
  const cv::Mat image = Decode(bytes);
  if (image.empty()) return Broken(name, bytes);
  return ImageSize{image.cols, image.rows};
}

Status CheckImage(const View& view, const Camera& camera) {
  const ImageSize expected = {camera.width, camera.height};
  if (view.image) {
    return IsOfSize("Image " + view.name,
                    expected)({view.image->width, view.image->height});
  }
  const std::string name = "Image " + view.image_path.string();
  return CheckFile(view.image_path, name, IsOfSize(name, expected));
}

Status CheckImageAndMask(const View& view, const Camera& camera) {
  Status status = CheckImage(view, camera);
  if (!status.ok() || view.mask_path.empty()) return status;
  const std::string name = "Mask " + view.mask_path.string();
  return CheckFile(
      view.mask_path, name, IsOfShape(name, {camera.width, camera.height}));
}

Result<GrayImage> LoadGrayImage(const View& view, const Camera& camera) {
  const ImageSize expected = {camera.width, camera.height};
  if (!view.image) {
    const std::string name = "Image " + view.image_path.string();
    return LoadFile(view.image_path, name, IsOfSize(name, expected));
  }
  const ImageInMemory& image = *view.image;
  const ImageSize size = {image.width, image.height};
  CURVIX_RETURN_IF_ERROR(CheckImage(view, camera));
  constexpr int kRed = 0;
  std::optional<GrayImage> gray = std::visit(
      [&](const auto& values) -> std::optional<GrayImage> {
        if (values == nullptr) return std::nullopt;
        const auto max_value =
            std::numeric_limits<std::decay_t<decltype(values[0])>>::max();
        return ToGrey(values.get(), size, image.num_channels, kRed, max_value);
      },
      image.values);
  if (gray) return *std::move(gray);
  return Status::InvalidArgument(
      "Image " + view.name +
      " in memory has no values, or a number of channels other "
      "than 1, 3 and 4.");
}

Result<std::optional<GrayImage>> LoadMask(const View& view,
                                          const Camera& camera) {
  if (view.mask_path.empty()) return std::optional<GrayImage>();
  const ImageSize expected = {camera.width, camera.height};
  const std::string name = "Mask " + view.mask_path.string();
  CURVIX_ASSIGN_OR_RETURN(
      GrayImage mask,
      LoadFile(view.mask_path, name, IsOfShape(name, expected)));
  const bool fits = ImageSize{mask.width, mask.height} == expected;
  return std::optional(fits ? std::move(mask)
                            : Resized(std::move(mask), expected));
}

}  // namespace curvix
