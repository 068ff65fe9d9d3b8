// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "base/bytes.h"
#include "base/count_text.h"
#include "base/text_fields.h"

namespace curvix {

struct PlyScalar {
  std::string_view name, other_name;
  std::size_t size;  // bytes
  double (*load)(const char* bytes, std::endian order);
};

namespace {

template <typename T>
double Load(const char* bytes, std::endian order) {
  return static_cast<double>(LoadBytes<T>(bytes, order));
}

constexpr std::array<PlyScalar, 8> kScalars = {
    {{"char", "int8", 1, Load<std::int8_t>},
     {"uchar", "uint8", 1, Load<std::uint8_t>},
     {"short", "int16", 2, Load<std::int16_t>},
     {"ushort", "uint16", 2, Load<std::uint16_t>},
     {"int", "int32", 4, Load<std::int32_t>},
     {"uint", "uint32", 4, Load<std::uint32_t>},
     {"float", "float32", 4, Load<float>},
     {"double", "float64", 8, Load<double>}}};

// Null if there is none.
const PlyScalar* TypeOf(std::string_view name) {
  for (const PlyScalar& scalar : kScalars) {
    if (name == scalar.name || name == scalar.other_name) return &scalar;
  }
  return nullptr;
}

std::optional<PlyFormat> FormatOf(std::string_view name) {
  if (name == "ascii") return PlyFormat::kAscii;
  if (name == "binary_little_endian") return PlyFormat::kBinaryLittleEndian;
  if (name == "binary_big_endian") return PlyFormat::kBinaryBigEndian;
  return std::nullopt;
}

std::optional<PlyElement> ParseElement(std::string_view words) {
  PlyElement element;
  element.name = TakeWord(words);
  const auto count = ParseNumber<std::uint64_t>(TakeWord(words));
  if (!count) return std::nullopt;
  element.count = *count;
  return element;
}

std::optional<PlyProperty> ParseProperty(std::string_view words) {
  PlyProperty property;
  std::string_view type_name = TakeWord(words);
  if (type_name == "list") {
    property.count_type = TypeOf(TakeWord(words));
    if (property.count_type == nullptr) return std::nullopt;
    type_name = TakeWord(words);
  }
  property.type = TypeOf(type_name);
  property.name = TakeWord(words);
  if (property.type == nullptr || property.name.empty()) return std::nullopt;
  return property;
}

// Adds what one line says to `header`; false if it says nothing sensible.
bool ParseHeaderLine(std::string_view line, PlyHeader& header) {
  const std::string_view keyword = TakeWord(line);
  if (keyword.empty() || keyword == "comment" || keyword == "obj_info") {
    return true;
  }
  if (keyword == "format") {
    const std::optional<PlyFormat> format = FormatOf(TakeWord(line));
    if (format) header.format = *format;
    return format.has_value();
  }
  if (keyword == "element") {
    std::optional<PlyElement> element = ParseElement(line);
    if (!element) return false;
    header.elements.push_back(*std::move(element));
    return true;
  }
  if (keyword == "property" && !header.elements.empty()) {
    std::optional<PlyProperty> property = ParseProperty(line);
    if (!property) return false;
    header.elements.back().properties.push_back(*std::move(property));
    return true;
  }
  return false;
}

// What comes first in a row: the scalar, or the length of the list.
const PlyScalar& FirstType(const PlyProperty& property) {
  return property.count_type != nullptr ? *property.count_type : *property.type;
}

std::optional<double> TakeScalar(const PlyScalar& type,
                                 PlyFormat format,
                                 std::string_view& body) {
  if (format == PlyFormat::kAscii) {
    return ParseNumber<double>(TakeWord(body));
  }
  if (body.size() < type.size) return std::nullopt;
  const double value =
      type.load(body.data(),
                format == PlyFormat::kBinaryBigEndian ? std::endian::big
                                                      : std::endian::little);
  body.remove_prefix(type.size);
  return value;
}

bool SkipListItems(const PlyProperty& property,
                   double count,
                   PlyFormat format,
                   std::string_view& body) {
  // Every item takes at least a byte.
  if (!(count >= 0 && count <= static_cast<double>(body.size()))) return false;
  for (auto left = static_cast<std::uint64_t>(count); left > 0; --left) {
    if (!TakeScalar(*property.type, format, body)) return false;
  }
  return true;
}

// Reads one row into `row`: a scalar per property, the length for a list.
bool TakeRow(const PlyElement& element,
             PlyFormat format,
             std::string_view& body,
             std::vector<double>& row) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    const std::optional<double> value =
        TakeScalar(FirstType(property), format, body);
    if (!value) return false;
    row[i] = *value;
    if (property.count_type != nullptr &&
        !SkipListItems(property, *value, format, body)) {
      return false;
    }
  }
  return true;
}

// The least number of bytes that a row takes.
std::uint64_t MinRowBytes(const PlyElement& element, PlyFormat format) {
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += format == PlyFormat::kAscii
                 ? 2  // a digit and the blank or line end after it
                 : FirstType(property).size;
  }
  return bytes;
}

Status Broken(const PlyElement& element, std::uint64_t row) {
  return Status::DataLoss("element " + element.name + " announces " +
                          Plural(element.count, "row") +
                          " but ends or breaks in row " + std::to_string(row) +
                          "; the file is truncated or damaged");
}

}  // namespace

Result<PlyHeader> TakePlyHeader(std::string_view& bytes) {
  if (TakeLine(bytes) != "ply") return Status::DataLoss("the file is not PLY");
  PlyHeader header;
  while (!bytes.empty()) {
    const std::string_view line = TakeLine(bytes);
    if (line == "end_header") return header;
    if (ParseHeaderLine(line, header)) continue;
    return Status::DataLoss(
        "the PLY header has a line that is not understood: \"" +
        std::string(line.substr(0, 80)) + "\"");
  }
  return Status::DataLoss(
      "the PLY header has no end_header; the file is truncated");
}

std::optional<std::vector<std::size_t>> FindScalars(
    const PlyElement& element, const std::vector<std::string_view>& names) {
  std::vector<std::size_t> columns;
  for (const std::string_view name : names) {
    const auto& properties = element.properties;
    const auto found =
        std::ranges::find_if(properties, [&](const PlyProperty& property) {
          return property.name == name && property.count_type == nullptr;
        });
    if (found == properties.end()) return std::nullopt;
    columns.push_back(static_cast<std::size_t>(found - properties.begin()));
  }
  return columns;
}

Result<std::vector<double>> TakePlyRows(const PlyElement& element,
                                        PlyFormat format,
                                        const std::vector<std::size_t>& wanted,
                                        std::string_view& body) {
  std::vector<double> table;
  const std::uint64_t row_bytes = MinRowBytes(element, format);
  if (row_bytes == 0) return table;
  // The last blank of an ASCII file may be missing.
  const std::uint64_t max_rows = (body.size() + 1) / row_bytes;
  if (element.count > max_rows) return Broken(element, max_rows);

  table.reserve(element.count * wanted.size());
  std::vector<double> row(element.properties.size());
  for (std::uint64_t i = 0; i < element.count; ++i) {
    if (!TakeRow(element, format, body, row)) return Broken(element, i);
    for (const std::size_t column : wanted) table.push_back(row[column]);
  }
  return table;
}

}  // namespace curvix
