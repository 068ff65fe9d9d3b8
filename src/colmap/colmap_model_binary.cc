// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include <curvix/scene.h>
#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

#include "colmap/colmap_model_format.h"

namespace curvix {
namespace {

static_assert(std::endian::native == std::endian::little,
              "COLMAP's binary files are read and written by copying bytes");

// Reads values from the front of a string. The first read beyond the end
// fails; from then on everything reads as zero and counts as none.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  bool failed() const { return failed_; }
  std::size_t bytes_left() const { return bytes_.size(); }

  template <typename T>
  T Read() {
    static_assert(std::is_arithmetic_v<T>);
    T value{};
    if (failed_ || bytes_.size() < sizeof(T)) {
      failed_ = true;
      return T{};
    }
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
    return value;
  }

  // A count of items of at least `item_size` bytes each; fails if they cannot
  // be there.
  std::size_t ReadCount(std::size_t item_size) {
    const std::uint64_t count = Read<std::uint64_t>();
    if (failed_ || count > bytes_.size() / item_size) {
      failed_ = true;
      return 0;
    }
    return static_cast<std::size_t>(count);
  }

  // The characters up to the next NUL, which is taken too.
  std::string ReadName() {
    const std::size_t length = bytes_.find('\0');
    if (failed_ || length == std::string_view::npos) {
      failed_ = true;
      return "";
    }
    std::string name(bytes_.substr(0, length));
    bytes_.remove_prefix(length + 1);
    return name;
  }

 private:
  std::string_view bytes_;
  bool failed_ = false;
};

class ByteWriter {
 public:
  template <typename T>
  void Write(std::type_identity_t<T> value) {
    const std::size_t end = bytes_.size();
    bytes_.resize(end + sizeof(T));
    std::memcpy(bytes_.data() + end, &value, sizeof(T));
  }
  void WriteName(const std::string& name) {
    bytes_ += name;
    bytes_ += '\0';
  }
  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

constexpr std::size_t kMinCameraSize = 4 + 4 + 8 + 8 + 2 * 8;
constexpr std::size_t kMinImageSize = 4 + 7 * 8 + 4 + 1 + 8;
constexpr std::size_t kPoint2DSize = 8 + 8 + 8;
constexpr std::size_t kMinPoint3DSize = 8 + 3 * 8 + 3 + 8 + 8;
constexpr std::size_t kTrackElementSize = 4 + 4;

Status Truncated(const std::string& file,
                 const std::string& item,
                 std::size_t index,
                 std::size_t count) {
  return {StatusCode::kDataLoss,
          file + " ends inside " + item + " " + std::to_string(index + 1) +
              " of " + std::to_string(count) +
              ", or a count in it is wrong; export the model again."};
}

// Parses a count and as many items with `parse_item(reader)`, which returns a
// Result<Item>, and checks that this is the whole file.
template <typename Item, typename ParseItem>
Result<std::vector<Item>> ParseAll(std::string_view bytes,
                                   const std::string& file,
                                   const std::string& item_name,
                                   std::size_t min_item_size,
                                   const ParseItem& parse_item) {
  ByteReader reader(bytes);
  const std::size_t count = reader.ReadCount(min_item_size);
  if (reader.failed()) {
    return Status(StatusCode::kDataLoss,
                  file + " is too short for the number of " + item_name +
                      "s that it announces; export the model again.");
  }
  std::vector<Item> items;
  items.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    Result<Item> item = parse_item(reader);
    if (reader.failed()) return Truncated(file, item_name, i, count);
    if (!item.ok()) return item.status();
    items.push_back(std::move(item).value());
  }
  if (reader.bytes_left() > 0) {
    return Status(StatusCode::kDataLoss,
                  file + " has " + std::to_string(reader.bytes_left()) +
                      " bytes more than its " + std::to_string(count) + " " +
                      item_name + "s take; export the model again.");
  }
  return items;
}

// Sizes beyond int do not make a camera; 0 makes Validate say so.
int ImageSize(std::uint64_t size) {
  return size > std::numeric_limits<int>::max() ? 0 : static_cast<int>(size);
}

ColmapImage ParseImage(ByteReader& reader) {
  ColmapImage image;
  image.image_id = reader.Read<std::uint32_t>();
  std::array<double, 4> wxyz;
  for (double& q : wxyz) q = reader.Read<double>();
  image.cam_from_world.rotation = RotationFromColmap(wxyz);
  for (double& t : image.cam_from_world.translation) t = reader.Read<double>();
  image.camera_id = reader.Read<std::uint32_t>();
  image.name = reader.ReadName();
  image.points2D.resize(reader.ReadCount(kPoint2DSize));
  for (ColmapPoint2D& point : image.points2D) {
    point.x = reader.Read<double>();
    point.y = reader.Read<double>();
    point.point3D_id = reader.Read<std::uint64_t>();
  }
  return image;
}

ColmapPoint3D ParsePoint(ByteReader& reader) {
  ColmapPoint3D point;
  point.point3D_id = reader.Read<std::uint64_t>();
  for (double& x : point.position) x = reader.Read<double>();
  for (std::uint8_t& c : point.rgb) c = reader.Read<std::uint8_t>();
  point.error = reader.Read<double>();
  point.track.resize(reader.ReadCount(kTrackElementSize));
  for (ColmapTrackElement& element : point.track) {
    element.image_id = reader.Read<std::uint32_t>();
    element.point2D_idx = reader.Read<std::uint32_t>();
  }
  return point;
}

}  // namespace

CamerasOrError ParseCamerasBinary(std::string_view bytes,
                                  const std::string& file) {
  const auto parse_camera = [&](ByteReader& reader) -> Result<ColmapCamera> {
    ColmapCamera item;
    item.camera_id = reader.Read<std::uint32_t>();
    const int model_id = reader.Read<std::int32_t>();
    item.camera.width = ImageSize(reader.Read<std::uint64_t>());
    item.camera.height = ImageSize(reader.Read<std::uint64_t>());
    const std::optional<CameraModel> model = ModelFromId(model_id);
    if (!model) {
      const std::string name = model_id == 17
                                   ? "EQUIRECTANGULAR"
                                   : "with id " + std::to_string(model_id);
      return UnsupportedCameraModel(file, item.camera_id, name);
    }
    item.camera.model = *model;
    item.camera.params.resize(static_cast<std::size_t>(NumParams(*model)));
    for (double& p : item.camera.params) p = reader.Read<double>();
    return item;
  };
  return ParseAll<ColmapCamera>(
      bytes, file, "camera", kMinCameraSize, parse_camera);
}

ImagesOrError ParseImagesBinary(std::string_view bytes,
                                const std::string& file) {
  return ParseAll<ColmapImage>(
      bytes, file, "image", kMinImageSize, [](ByteReader& reader) {
        return Result<ColmapImage>(ParseImage(reader));
      });
}

PointsOrError ParsePointsBinary(std::string_view bytes,
                                const std::string& file) {
  return ParseAll<ColmapPoint3D>(
      bytes, file, "point", kMinPoint3DSize, [](ByteReader& reader) {
        return Result<ColmapPoint3D>(ParsePoint(reader));
      });
}

std::string FormatCamerasBinary(const std::vector<ColmapCamera>& cameras) {
  ByteWriter writer;
  writer.Write<std::uint64_t>(cameras.size());
  for (const ColmapCamera& item : cameras) {
    writer.Write<std::uint32_t>(item.camera_id);
    writer.Write<std::int32_t>(static_cast<std::int32_t>(item.camera.model));
    writer.Write<std::uint64_t>(static_cast<std::uint64_t>(item.camera.width));
    writer.Write<std::uint64_t>(static_cast<std::uint64_t>(item.camera.height));
    for (const double p : item.camera.params) writer.Write<double>(p);
  }
  return writer.Take();
}

std::string FormatImagesBinary(const std::vector<ColmapImage>& images) {
  ByteWriter writer;
  writer.Write<std::uint64_t>(images.size());
  for (const ColmapImage& image : images) {
    const Eigen::Quaterniond q = image.cam_from_world.rotation.normalized();
    writer.Write<std::uint32_t>(image.image_id);
    for (const double x : {q.w(), q.x(), q.y(), q.z()}) writer.Write<double>(x);
    for (const double t : image.cam_from_world.translation) {
      writer.Write<double>(t);
    }
    writer.Write<std::uint32_t>(image.camera_id);
    writer.WriteName(image.name);
    writer.Write<std::uint64_t>(image.points2D.size());
    for (const ColmapPoint2D& point : image.points2D) {
      writer.Write<double>(point.x);
      writer.Write<double>(point.y);
      writer.Write<std::uint64_t>(point.point3D_id);
    }
  }
  return writer.Take();
}

std::string FormatPointsBinary(const std::vector<ColmapPoint3D>& points) {
  ByteWriter writer;
  writer.Write<std::uint64_t>(points.size());
  for (const ColmapPoint3D& point : points) {
    writer.Write<std::uint64_t>(point.point3D_id);
    for (const double x : point.position) writer.Write<double>(x);
    for (const std::uint8_t c : point.rgb) writer.Write<std::uint8_t>(c);
    writer.Write<double>(point.error);
    writer.Write<std::uint64_t>(point.track.size());
    for (const ColmapTrackElement& element : point.track) {
      writer.Write<std::uint32_t>(element.image_id);
      writer.Write<std::uint32_t>(element.point2D_idx);
    }
  }
  return writer.Take();
}

}  // namespace curvix
