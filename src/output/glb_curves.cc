// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves for programs that show glTF.
#include "output/glb_curves.h"

#include <curvix/text_fields.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <curvix/curve_style.h>
#include "output/bytes.h"

namespace curvix {
namespace {

constexpr std::size_t kPositionBytes = 12;
constexpr std::size_t kColorBytes = 4;
constexpr int kLineLoop = 2;
constexpr int kLineStrip = 3;

std::string Text(double value) {
  std::string text;
  AppendNumber(value, text);
  return text;
}

std::string VectorText(const Eigen::Vector3f& v) {
  std::string text = "[";
  for (int i = 0; i < 3; ++i) {
    if (i > 0) text += ',';
    AppendNumber(v[i], text);
  }
  return text + "]";
}

// What the JSON part lists, and the bytes that it refers to.
struct Lists {
  std::string accessors;
  std::string primitives;
  std::string positions;
  std::string colors;
};

void AddCurve(const Curve& curve,
              std::size_t id,
              const Eigen::Vector3d& middle,
              Lists& lists) {
  const std::size_t count = curve.samples.size();
  const std::size_t position_offset = lists.positions.size();
  const std::size_t color_offset = lists.colors.size();
  Eigen::AlignedBox3f box;
  const Rgb color = CurveColor(id);
  for (const CurveSample& sample : curve.samples) {
    const Eigen::Vector3f p = (sample.position - middle).cast<float>();
    box.extend(p);
    for (int i = 0; i < 3; ++i) AppendLittleEndian(p[i], lists.positions);
    for (const std::uint8_t c : color) AppendLittleEndian(c, lists.colors);
    AppendLittleEndian(std::uint8_t{255}, lists.colors);
  }
  const std::string comma = id > 0 ? "," : "";
  const std::string count_text = std::to_string(count);
  lists.accessors +=
      comma +
      "{\"bufferView\":0,\"componentType\":5126,\"type\":"
      "\"VEC3\",\"byteOffset\":" +
      std::to_string(position_offset) + ",\"count\":" + count_text +
      ",\"min\":" + VectorText(box.min()) +
      ",\"max\":" + VectorText(box.max()) +
      "},{\"bufferView\":1,\"componentType\":5121,"
      "\"normalized\":true,\"type\":\"VEC4\",\"byteOffset\":" +
      std::to_string(color_offset) + ",\"count\":" + count_text + "}";
  lists.primitives +=
      comma + "{\"attributes\":{\"POSITION\":" + std::to_string(2 * id) +
      ",\"COLOR_0\":" + std::to_string(2 * id + 1) +
      "},\"material\":0,\"mode\":" +
      std::to_string(curve.closed ? kLineLoop : kLineStrip) +
      ",\"extras\":{\"curve_id\":" + std::to_string(id) + "}}";
}

std::string Json(const Lists& lists, const Eigen::Vector3d& middle) {
  const std::string num_positions = std::to_string(lists.positions.size());
  const std::string num_colors = std::to_string(lists.colors.size());
  std::string json =
      "{\"asset\":{\"version\":\"2.0\",\"generator\":\"curvix\"},"
      "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
      "\"nodes\":[{\"name\":\"curves\"";
  if (lists.primitives.empty()) return json + "}]}";
  json += ",\"mesh\":0,\"translation\":[" + Text(middle.x()) + "," +
          Text(middle.y()) + "," + Text(middle.z()) +
          "]}],\"meshes\":[{\"name\":\"curves\",\"primitives\":[" +
          lists.primitives +
          "]}],\"materials\":[{\"extensions\":{\"KHR_materials_unlit\":{}},"
          "\"pbrMetallicRoughness\":{\"metallicFactor\":0}}],"
          "\"extensionsUsed\":[\"KHR_materials_unlit\"],\"accessors\":[" +
          lists.accessors +
          "],\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteStride\":" +
          std::to_string(kPositionBytes) +
          ",\"target\":34962,\"byteLength\":" + num_positions +
          "},{\"buffer\":0,\"byteOffset\":" + num_positions +
          ",\"byteStride\":" + std::to_string(kColorBytes) +
          ",\"target\":34962,\"byteLength\":" + num_colors +
          "}],\"buffers\":[{\"byteLength\":" +
          std::to_string(lists.positions.size() + lists.colors.size()) + "}]}";
  return json;
}

Eigen::Vector3d Middle(const CurveSet& curves) {
  Eigen::AlignedBox3d box;
  for (const Curve& curve : curves.curves) {
    for (const CurveSample& sample : curve.samples) box.extend(sample.position);
  }
  return box.isEmpty() ? Eigen::Vector3d(0, 0, 0) : box.center();
}

void AppendChunk(std::uint32_t type,
                 const std::string& data,
                 std::string& out) {
  AppendLittleEndian(static_cast<std::uint32_t>(data.size()), out);
  AppendLittleEndian(type, out);
  out += data;
}

}  // namespace

Result<std::string> EncodeGlbCurves(const CurveSet& curves) {
  constexpr std::uint32_t kMagic = 0x46546C67;  // "glTF"
  constexpr std::uint32_t kJson = 0x4E4F534A;
  constexpr std::uint32_t kBinary = 0x004E4942;
  const Eigen::Vector3d middle = Middle(curves);
  Lists lists;
  for (std::size_t id = 0; id < curves.curves.size(); ++id) {
    AddCurve(curves.curves[id], id, middle, lists);
  }
  std::string json = Json(lists, middle);
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::string binary = lists.positions + lists.colors;
  const bool has_binary = !binary.empty();
  const std::size_t size =
      12 + 8 + json.size() + (has_binary ? 8 + binary.size() : 0);
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    return Status(StatusCode::kUnsupported,
                  "the curves need more than the 4 GB that GLB can hold");
  }
  std::string out;
  AppendLittleEndian(kMagic, out);
  AppendLittleEndian(std::uint32_t{2}, out);
  AppendLittleEndian(static_cast<std::uint32_t>(size), out);
  AppendChunk(kJson, json, out);
  if (has_binary) AppendChunk(kBinary, binary, out);
  return out;
}

}  // namespace curvix
