// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include <curvix/scene.h>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>

#include "base/line_reader.h"
#include "colmap/colmap_model_format.h"

namespace curvix {
namespace {

Status Malformed(const std::string& file,
                 const LineReader& lines,
                 const std::string& expected) {
  return Status::DataLoss(
      file + ", line " + std::to_string(lines.line_number()) + " is not \"" +
      expected + "\"; correct it or export the model again.");
}

// Here, where the lines are known.
Status SameId(const std::string& file,
              const LineReader& lines,
              std::uint32_t image_id,
              std::size_t first_line) {
  return Status::DataLoss(
      file + ", line " + std::to_string(lines.line_number()) +
      " has the image id " + std::to_string(image_id) + " of line " +
      std::to_string(first_line) +
      "; give one of the two images another id or export the model again.");
}

Result<ColmapCamera> ParseCamera(std::string_view line,
                                 const LineReader& lines,
                                 const std::string& file) {
  WordReader words(line);
  ColmapCamera item;
  item.camera_id = words.Number<std::uint32_t>();
  const std::string model_name(words.Word());
  item.camera.width = words.Number<int>();
  item.camera.height = words.Number<int>();
  if (words.failed()) {
    return Malformed(file, lines, "CAMERA_ID MODEL WIDTH HEIGHT PARAMS...");
  }
  const std::optional<CameraModel> model = ModelFromName(model_name);
  if (!model) return UnsupportedCameraModel(file, item.camera_id, model_name);
  item.camera.model = *model;
  while (!words.AtEnd()) item.camera.params.push_back(words.Number<double>());
  const std::size_t expected = static_cast<std::size_t>(NumParams(*model));
  if (words.failed() || item.camera.params.size() != expected) {
    return Malformed(file,
                     lines,
                     "CAMERA_ID " + model_name + " WIDTH HEIGHT and " +
                         std::to_string(expected) + " numbers");
  }
  return item;
}

// The line `ID QW QX QY QZ TX TY TZ CAMERA_ID NAME`; false if it is not one.
bool ParsePose(std::string_view line, ColmapImage* image) {
  WordReader words(line);
  image->image_id = words.Number<std::uint32_t>();
  std::array<double, 4> wxyz;
  for (double& q : wxyz) q = words.Number<double>();
  image->cam_from_world.rotation = RotationFromColmap(wxyz);
  for (double& t : image->cam_from_world.translation) {
    t = words.Number<double>();
  }
  image->camera_id = words.Number<std::uint32_t>();
  image->name = words.Rest();
  return !words.failed();
}

// The line of `X Y POINT3D_ID` triples; false if it is not one.
bool ParsePoints2D(std::string_view line, ColmapImage* image) {
  WordReader words(line);
  while (!words.AtEnd()) {
    ColmapPoint2D& point = image->points2D.emplace_back();
    point.x = words.Number<double>();
    point.y = words.Number<double>();
    point.point3D_id =
        words.Skip("-1") ? kNoPoint3D : words.Number<std::uint64_t>();
  }
  return !words.failed();
}

bool ParsePoint(std::string_view line, ColmapPoint3D* point) {
  WordReader words(line);
  point->point3D_id = words.Number<std::uint64_t>();
  for (double& x : point->position) x = words.Number<double>();
  for (std::uint8_t& c : point->rgb) c = words.Number<std::uint8_t>();
  point->error = words.Number<double>();
  while (!words.AtEnd()) {
    ColmapTrackElement& element = point->track.emplace_back();
    element.image_id = words.Number<std::uint32_t>();
    element.point2D_idx = words.Number<std::uint32_t>();
  }
  return !words.failed();
}

}  // namespace

CamerasOrError ParseCamerasText(
    std::string_view bytes,
    const std::string& file,
    const std::function<bool(std::uint32_t)>& is_used) {
  LineReader lines(bytes);
  std::vector<ColmapCamera> cameras;
  while (const auto line = lines.NextFilled()) {
    Result<ColmapCamera> camera = ParseCamera(*line, lines, file);
    if (camera.ok()) {
      cameras.push_back(std::move(camera).value());
    } else if (camera.status().code() != StatusCode::kUnsupported ||
               is_used(WordReader(*line).Number<std::uint32_t>())) {
      return camera.status();
    }
  }
  return cameras;
}

ImagesOrError ParseImagesText(std::string_view bytes, const std::string& file) {
  LineReader lines(bytes);
  std::vector<ColmapImage> images;
  std::map<std::uint32_t, std::size_t> line_numbers;  // by image_id
  while (const auto line = lines.NextFilled()) {
    ColmapImage& image = images.emplace_back();
    if (!ParsePose(*line, &image)) {
      return Malformed(
          file, lines, "IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME");
    }
    const auto [first, is_new] =
        line_numbers.emplace(image.image_id, lines.line_number());
    if (!is_new) return SameId(file, lines, image.image_id, first->second);
    const auto points = lines.Next();
    if (points && !ParsePoints2D(*points, &image)) {
      return Malformed(file,
                       lines,
                       "X Y POINT3D_ID ...\" (an image takes two lines, of "
                       "which the second may be empty) of image \"" +
                           image.name);
    }
  }
  return images;
}

PointsOrError ParsePointsText(std::string_view bytes, const std::string& file) {
  LineReader lines(bytes);
  std::vector<ColmapPoint3D> points;
  while (const auto line = lines.NextFilled()) {
    if (!ParsePoint(*line, &points.emplace_back())) {
      return Malformed(
          file,
          lines,
          "POINT3D_ID X Y Z R G B ERROR (IMAGE_ID POINT2D_IDX)...");
    }
  }
  return points;
}

}  // namespace curvix
