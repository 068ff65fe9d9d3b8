// SPDX-License-Identifier: BSD-3-Clause
// COLMAP's models as text, which the program reads but does not write.
#pragma once

#include <curvix/scene.h>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/file_io.h"
#include "base/text_fields.h"
#include "colmap/colmap_model.h"
#include "colmap/colmap_model_format.h"

namespace curvix {

// Appends words to lines, exactly one space between them: COLMAP 3.8 splits at
// single spaces. Numbers in the shortest form that reads back exactly.
class LineWriter {
 public:
  explicit LineWriter(std::string_view comment) : text_("# ") {
    text_ += comment;
    text_ += '\n';
  }

  LineWriter& operator<<(std::string_view word) {
    if (text_.back() != '\n') text_ += ' ';
    text_ += word;
    return *this;
  }
  template <typename T>
  requires std::is_arithmetic_v<T> LineWriter& operator<<(T number) {
    return *this << std::string_view(NumberText(number));
  }
  void EndLine() { text_ += '\n'; }
  std::string Take() { return std::move(text_); }

 private:
  std::string text_;
};

inline std::string FormatCamerasText(const std::vector<ColmapCamera>& cameras) {
  LineWriter writer("CAMERA_ID MODEL WIDTH HEIGHT PARAMS...");
  for (const ColmapCamera& item : cameras) {
    writer << item.camera_id << ModelName(item.camera.model)
           << item.camera.width << item.camera.height;
    for (const double p : item.camera.params) writer << p;
    writer.EndLine();
  }
  return writer.Take();
}

inline std::string FormatImagesText(const std::vector<ColmapImage>& images) {
  LineWriter writer(
      "IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, then a line of "
      "X Y POINT3D_ID ...");
  for (const ColmapImage& image : images) {
    const Eigen::Quaterniond q = image.cam_from_world.rotation.normalized();
    writer << image.image_id << q.w() << q.x() << q.y() << q.z();
    for (const double t : image.cam_from_world.translation) writer << t;
    writer << image.camera_id << image.name;
    writer.EndLine();
    for (const ColmapPoint2D& point : image.points2D) {
      writer << point.x << point.y;
      if (point.point3D_id == kNoPoint3D) {
        writer << "-1";
      } else {
        writer << point.point3D_id;
      }
    }
    writer.EndLine();
  }
  return writer.Take();
}

inline std::string FormatPointsText(const std::vector<ColmapPoint3D>& points) {
  LineWriter writer("POINT3D_ID X Y Z R G B ERROR (IMAGE_ID POINT2D_IDX)...");
  for (const ColmapPoint3D& point : points) {
    writer << point.point3D_id;
    for (const double x : point.position) writer << x;
    for (const std::uint8_t c : point.rgb) writer << int{c};
    writer << point.error;
    for (const ColmapTrackElement& element : point.track) {
      writer << element.image_id << element.point2D_idx;
    }
    writer.EndLine();
  }
  return writer.Take();
}

// As if an image used each camera.
inline CamerasOrError ParseAllCamerasText(std::string_view bytes,
                                          const std::string& file) {
  return ParseCamerasText(bytes, file, [](std::uint32_t) { return true; });
}

// cameras.txt, images.txt and points3D.txt in `folder`, which is made if
// needed. Names must not begin or end with a space.
inline Status WriteTextModel(const ColmapModel& model,
                             const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const auto& [name, text] :
       {std::pair{"cameras.txt", FormatCamerasText(model.cameras)},
        std::pair{"images.txt", FormatImagesText(model.images)},
        std::pair{"points3D.txt", FormatPointsText(model.points)}}) {
    Status status = WriteFileAtomically(folder / name, text);
    if (!status.ok()) return status;
  }
  return {};
}

}  // namespace curvix
