// SPDX-License-Identifier: BSD-3-Clause
#include "colmap/scale_to_images.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <vector>

#include "base/count_text.h"
#include "base/image_header.h"
#include "colmap/files.h"
#include "geometry/distortion.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;

// Images larger or smaller than this are not taken for copies.
constexpr double kMaxScale = 32;

struct Scale {
  double x = 1;
  double y = 1;
};

// By camera_id: that of most of its images; nullopt: of none, or not known.
std::map<std::uint32_t, std::optional<ImageSize>> SizesOfImages(
    const fs::path& folder, const ColmapModel& model) {
  std::map<std::uint32_t, std::vector<std::optional<ImageSize>>> all;
  for (const ColmapImage& image : model.images) {
    const fs::path file = ImageFile(folder, image.name);
    if (!IsFile(file)) continue;
    const std::optional<ImageHeader> header = ReadImageHeader(file);
    all[image.camera_id].push_back(header ? std::optional(header->size)
                                          : std::nullopt);
  }
  std::map<std::uint32_t, std::optional<ImageSize>> sizes;
  for (const auto& [camera_id, of_images] : all) {
    std::optional<ImageSize>& size = sizes[camera_id];
    for (const std::optional<ImageSize>& one : of_images) {
      if (2 * std::ranges::count(of_images, one) > std::ssize(of_images)) {
        size = one;
      }
    }
  }
  return sizes;
}

// nullopt: the camera is to stay as it is, also if a row or column is missing.
std::optional<Scale> ScaleTo(const ImageSize& size, const Camera& camera) {
  if (std::abs(size.width - camera.width) <= 1 ||
      std::abs(size.height - camera.height) <= 1) {
    return std::nullopt;
  }
  const Scale scale = {size.width / static_cast<double>(camera.width),
                       size.height / static_cast<double>(camera.height)};
  const bool is_alike = HaveSameShape(size, {camera.width, camera.height});
  const bool is_plausible = std::abs(std::log(scale.x)) <= std::log(kMaxScale);
  return is_alike && is_plausible ? std::optional(scale) : std::nullopt;
}

// Distortion is in units of the focal length.
void Rescale(const Scale& scale, const ImageSize& size, Camera* camera) {
  std::vector<double>& p = camera->params;
  if (NumFocalLengths(camera->model) == 1) {
    p[0] *= (scale.x + scale.y) / 2;
    p[1] *= scale.x;
    p[2] *= scale.y;
  } else {
    p[0] *= scale.x;
    p[1] *= scale.y;
    p[2] *= scale.x;
    p[3] *= scale.y;
  }
  camera->width = size.width;
  camera->height = size.height;
}

}  // namespace

std::string ScaleToImages(const fs::path& folder, ColmapModel* model) {
  const auto sizes = SizesOfImages(folder, *model);
  std::map<std::uint32_t, Scale> scales;
  std::string first;
  for (ColmapCamera& item : model->cameras) {
    const auto size = sizes.find(item.camera_id);
    if (size == sizes.end() || !size->second) continue;
    const auto scale = ScaleTo(*size->second, item.camera);
    if (!scale) continue;
    if (scales.empty()) {
      first = SizeText(*size->second) + " pixels instead of " +
              SizeText({item.camera.width, item.camera.height});
    }
    scales.emplace(item.camera_id, *scale);
    Rescale(*scale, *size->second, &item.camera);
  }
  if (scales.empty()) return "";
  for (ColmapImage& image : model->images) {
    const auto scale = scales.find(image.camera_id);
    if (scale == scales.end()) continue;
    for (ColmapPoint2D& point : image.points2D) {
      point.x *= scale->second.x;
      point.y *= scale->second.y;
    }
  }
  for (ColmapPoint3D& point : model->points) point.error = -1;
  return "The images of " + std::to_string(scales.size()) + " of " +
         Plural(model->cameras.size(), "camera") +
         " have another size than the model says (" + first + "); " +
         OneOrMore(scales.size(), "this camera is", "these cameras are") +
         " scaled to them.";
}

}  // namespace curvix
