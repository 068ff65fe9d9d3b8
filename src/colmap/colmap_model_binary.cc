// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include <curvix/scene.h>
#include <utility>

#include "base/bytes.h"
#include "base/count_text.h"
#include "colmap/colmap_model_format.h"

namespace curvix {
namespace {

constexpr std::size_t kMinCameraSize = 4 + 4 + 8 + 8 + 2 * 8;
constexpr std::size_t kMinImageSize = 4 + 7 * 8 + 4 + 1 + 8;
constexpr std::size_t kPoint2DSize = 8 + 8 + 8;
constexpr std::size_t kMinPoint3DSize = 8 + 3 * 8 + 3 + 8 + 8;
constexpr std::size_t kTrackElementSize = 4 + 4;

Status Truncated(const std::string& file,
                 const std::string& item,
                 std::size_t index,
                 std::size_t count) {
  return Status::DataLoss(
      file + " ends inside " + item + " " + std::to_string(index + 1) + " of " +
      std::to_string(count) +
      ", or a count in it is wrong; export the model again.");
}

// Parses a count and as many items with `parse_item(reader)`, which returns an
// Item or a Result<Item>, and checks that this is the whole file.
template <typename Item, typename ParseItem>
Result<std::vector<Item>> ParseAll(std::string_view bytes,
                                   const std::string& file,
                                   const std::string& item_name,
                                   std::size_t min_item_size,
                                   const ParseItem& parse_item) {
  ByteReader reader(bytes);
  const std::size_t count = reader.TakeCount(min_item_size);
  if (!reader.ok()) {
    return Status::DataLoss(file + " is too short for the number of " +
                            item_name +
                            "s that it announces; export the model again.");
  }
  std::vector<Item> items;
  items.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Result<Item> item = parse_item(reader);
    if (!reader.ok()) return Truncated(file, item_name, i, count);
    if (!item.ok()) return item.status();
    items.push_back(std::move(item).value());
  }
  if (!reader.AtEnd()) {
    return Status::DataLoss(
        file + " has " + Plural(reader.rest().size(), "byte") +
        " more than its " + Plural(count, item_name) +
        OneOrMore(count, " takes", " take") + "; export the model again.");
  }
  return items;
}

// Sizes beyond int do not make a camera; 0 makes Validate say so.
int SideOfImage(std::uint64_t size) {
  return size > std::numeric_limits<int>::max() ? 0 : static_cast<int>(size);
}

ColmapImage ParseImage(ByteReader& reader) {
  ColmapImage image;
  image.image_id = reader.Take<std::uint32_t>();
  std::array<double, 4> wxyz;
  for (double& q : wxyz) q = reader.Take<double>();
  image.cam_from_world.rotation = RotationFromColmap(wxyz);
  for (double& t : image.cam_from_world.translation) t = reader.Take<double>();
  image.camera_id = reader.Take<std::uint32_t>();
  image.name = reader.TakeName();
  image.points2D.resize(reader.TakeCount(kPoint2DSize));
  for (ColmapPoint2D& point : image.points2D) {
    point.x = reader.Take<double>();
    point.y = reader.Take<double>();
    point.point3D_id = reader.Take<std::uint64_t>();
  }
  return image;
}

ColmapPoint3D ParsePoint(ByteReader& reader) {
  ColmapPoint3D point;
  point.point3D_id = reader.Take<std::uint64_t>();
  for (double& x : point.position) x = reader.Take<double>();
  for (std::uint8_t& c : point.rgb) c = reader.Take<std::uint8_t>();
  point.error = reader.Take<double>();
  point.track.resize(reader.TakeCount(kTrackElementSize));
  for (ColmapTrackElement& element : point.track) {
    element.image_id = reader.Take<std::uint32_t>();
    element.point2D_idx = reader.Take<std::uint32_t>();
  }
  return point;
}

}  // namespace

CamerasOrError ParseCamerasBinary(std::string_view bytes,
                                  const std::string& file) {
  const auto parse_camera = [&](ByteReader& reader) -> Result<ColmapCamera> {
    ColmapCamera item;
    item.camera_id = reader.Take<std::uint32_t>();
    const int model_id = reader.Take<std::int32_t>();
    item.camera.width = SideOfImage(reader.Take<std::uint64_t>());
    item.camera.height = SideOfImage(reader.Take<std::uint64_t>());
    const std::optional<CameraModel> model = ModelFromId(model_id);
    if (!model) {
      const std::string name = model_id == 17
                                   ? "EQUIRECTANGULAR"
                                   : "with id " + std::to_string(model_id);
      return UnsupportedCameraModel(file, item.camera_id, name);
    }
    item.camera.model = *model;
    item.camera.params.resize(static_cast<std::size_t>(NumParams(*model)));
    for (double& p : item.camera.params) p = reader.Take<double>();
    return item;
  };
  return ParseAll<ColmapCamera>(
      bytes, file, "camera", kMinCameraSize, parse_camera);
}

ImagesOrError ParseImagesBinary(std::string_view bytes,
                                const std::string& file) {
  return ParseAll<ColmapImage>(bytes, file, "image", kMinImageSize, ParseImage);
}

PointsOrError ParsePointsBinary(std::string_view bytes,
                                const std::string& file) {
  return ParseAll<ColmapPoint3D>(
      bytes, file, "point", kMinPoint3DSize, ParsePoint);
}

std::string FormatCamerasBinary(const std::vector<ColmapCamera>& cameras) {
  ByteWriter writer;
  writer.PutCount(cameras.size());
  for (const ColmapCamera& item : cameras) {
    writer.Put(item.camera_id);
    writer.Put(static_cast<std::int32_t>(item.camera.model));
    writer.Put(static_cast<std::uint64_t>(item.camera.width));
    writer.Put(static_cast<std::uint64_t>(item.camera.height));
    for (const double p : item.camera.params) writer.Put(p);
  }
  return std::move(writer).bytes();
}

std::string FormatImagesBinary(const std::vector<ColmapImage>& images) {
  ByteWriter writer;
  writer.PutCount(images.size());
  for (const ColmapImage& image : images) {
    const Eigen::Quaterniond q = image.cam_from_world.rotation.normalized();
    writer.Put(image.image_id);
    for (const double x : {q.w(), q.x(), q.y(), q.z()}) writer.Put(x);
    for (const double t : image.cam_from_world.translation) {
      writer.Put(t);
    }
    writer.Put(image.camera_id);
    writer.PutName(image.name);
    writer.PutCount(image.points2D.size());
    for (const ColmapPoint2D& point : image.points2D) {
      writer.Put(point.x);
      writer.Put(point.y);
      writer.Put(point.point3D_id);
    }
  }
  return std::move(writer).bytes();
}

std::string FormatPointsBinary(const std::vector<ColmapPoint3D>& points) {
  ByteWriter writer;
  writer.PutCount(points.size());
  for (const ColmapPoint3D& point : points) {
    writer.Put(point.point3D_id);
    for (const double x : point.position) writer.Put(x);
    for (const std::uint8_t c : point.rgb) writer.Put(c);
    writer.Put(point.error);
    writer.PutCount(point.track.size());
    for (const ColmapTrackElement& element : point.track) {
      writer.Put(element.image_id);
      writer.Put(element.point2D_idx);
    }
  }
  return std::move(writer).bytes();
}

}  // namespace curvix
