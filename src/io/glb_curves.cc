// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves for programs that show glTF.
#include "io/curve_formats.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>

#include "base/bytes.h"
#include "base/text_fields.h"
#include "io/curve_style.h"

namespace curvix {
namespace {

constexpr std::size_t kPositionBytes = 12;
constexpr std::size_t kColorBytes = 4;
constexpr int kLineLoop = 2;
constexpr int kLineStrip = 3;
// In glTF y is up. Readers whose z is up turn it back.
const Eigen::Quaterniond kYUpFromZUp(std::sqrt(0.5), -std::sqrt(0.5), 0, 0);

template <typename Vector>
std::string VectorText(const Vector& v) {
  std::string text = "[";
  AppendNumbers(v, ',', text);
  return text + "]";
}

// What the JSON part lists, and how much it refers to.
struct Lists {
  std::string accessors;
  std::string primitives;
  std::size_t num_samples = 0;
};

Eigen::Vector3f Position(const CurveSample& sample,
                         const Eigen::Vector3d& middle) {
  return (sample.position - middle).cast<float>();
}

void AddCurve(const Curve& curve,
              std::size_t id,
              const Eigen::Vector3d& middle,
              Lists& lists) {
  const std::size_t count = curve.samples.size();
  Eigen::AlignedBox3f box;
  for (const CurveSample& sample : curve.samples) {
    box.extend(Position(sample, middle));
  }
  const std::string comma = id > 0 ? "," : "";
  const std::string count_text = std::to_string(count);
  lists.accessors += comma +
                     "{\"bufferView\":0,\"componentType\":5126,\"type\":"
                     "\"VEC3\",\"byteOffset\":" +
                     std::to_string(kPositionBytes * lists.num_samples) +
                     ",\"count\":" + count_text +
                     ",\"min\":" + VectorText(box.min()) +
                     ",\"max\":" + VectorText(box.max()) +
                     "},{\"bufferView\":1,\"componentType\":5121,"
                     "\"normalized\":true,\"type\":\"VEC4\",\"byteOffset\":" +
                     std::to_string(kColorBytes * lists.num_samples) +
                     ",\"count\":" + count_text + "}";
  lists.primitives +=
      comma + "{\"attributes\":{\"POSITION\":" + std::to_string(2 * id) +
      ",\"COLOR_0\":" + std::to_string(2 * id + 1) +
      "},\"material\":0,\"mode\":" +
      std::to_string(curve.closed ? kLineLoop : kLineStrip) +
      ",\"extras\":{\"curve_id\":" + std::to_string(id) + "}}";
  lists.num_samples += count;
}

std::string Json(const Lists& lists, const Eigen::Vector3d& middle) {
  const std::string num_positions =
      std::to_string(kPositionBytes * lists.num_samples);
  const std::string num_colors =
      std::to_string(kColorBytes * lists.num_samples);
  std::string json =
      "{\"asset\":{\"version\":\"2.0\",\"generator\":\"curvix\"},"
      "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
      "\"nodes\":[{\"name\":\"curves\"";
  if (lists.primitives.empty()) return json + "}]}";
  json += ",\"mesh\":0,\"rotation\":" + VectorText(kYUpFromZUp.coeffs()) +
          ",\"translation\":" + VectorText(kYUpFromZUp * middle) +
          "}],\"meshes\":[{\"name\":\"curves\",\"primitives\":[" +
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
          std::to_string((kPositionBytes + kColorBytes) * lists.num_samples) +
          "}]}";
  return json;
}

Eigen::Vector3d Middle(const CurveSource& curves) {
  Eigen::AlignedBox3d box;
  curves.ForEach([&](std::size_t, const Curve& curve) {
    for (const CurveSample& sample : curve.samples) box.extend(sample.position);
  });
  return box.isEmpty() ? Eigen::Vector3d(0, 0, 0) : box.center();
}

void PutPositions(const CurveSource& curves,
                  const Eigen::Vector3d& middle,
                  const ByteSink& sink) {
  curves.ForEach([&](std::size_t, const Curve& curve) {
    std::string out;
    for (const CurveSample& sample : curve.samples) {
      const Eigen::Vector3f p = Position(sample, middle);
      for (int i = 0; i < 3; ++i) AppendLittleEndian(p[i], out);
    }
    sink(out);
  });
}

// Linear, as colours of vertices are in glTF, of one that screens show.
std::uint8_t LinearFromSrgb(std::uint8_t srgb) {
  const double c = srgb / 255.0;
  const double linear =
      c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  return static_cast<std::uint8_t>(std::lround(255 * linear));
}

void PutColors(const CurveSource& curves, const ByteSink& sink) {
  curves.ForEach([&](std::size_t id, const Curve& curve) {
    std::string color;
    for (const std::uint8_t c : CurveColor(id)) {
      AppendLittleEndian(LinearFromSrgb(c), color);
    }
    AppendLittleEndian(std::uint8_t{255}, color);
    std::string out;
    for (std::size_t i = 0; i < curve.samples.size(); ++i) out += color;
    sink(out);
  });
}

// Numbers of 32 bits.
void PutWords(std::initializer_list<std::size_t> words, const ByteSink& sink) {
  std::string out;
  for (const std::size_t word : words) {
    AppendLittleEndian(static_cast<std::uint32_t>(word), out);
  }
  sink(out);
}

}  // namespace

Status EncodeGlbCurves(const CurveSource& curves, const ByteSink& sink) {
  constexpr std::size_t kMagic = 0x46546C67;  // "glTF"
  constexpr std::size_t kJson = 0x4E4F534A;
  constexpr std::size_t kBinary = 0x004E4942;
  const Eigen::Vector3d middle = Middle(curves);
  Lists lists;
  curves.ForEach([&](std::size_t id, const Curve& curve) {
    AddCurve(curve, id, middle, lists);
  });
  std::string json = Json(lists, middle);
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::size_t num_binary =
      (kPositionBytes + kColorBytes) * lists.num_samples;
  const std::size_t size =
      12 + 8 + json.size() + (num_binary > 0 ? 8 + num_binary : 0);
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    return Status::Unsupported(
        "the curves need more than the 4 GB that GLB can hold");
  }
  PutWords({kMagic, 2, size, json.size(), kJson}, sink);
  sink(json);
  if (num_binary == 0) return {};
  PutWords({num_binary, kBinary}, sink);
  PutPositions(curves, middle, sink);
  PutColors(curves, sink);
  return {};
}

}  // namespace curvix
