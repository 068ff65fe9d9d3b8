// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Any PLY file as columns of numbers.
#pragma once

#include <curvix/status.h>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace curvix {

enum class PlyFormat { kAscii, kBinaryLittleEndian, kBinaryBigEndian };

enum class PlyType {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64,
};

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;   // of the scalar, or of the list's items
  std::optional<PlyType> count_type;  // present if this is a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
};

// Takes the header, `end_header` included, off `bytes`. kDataLoss if it is not
// one.
Result<PlyHeader> TakePlyHeader(std::string_view& bytes);

// The scalar property `name` of `element`, if it has one.
std::optional<std::size_t> FindScalar(const PlyElement& element,
                                      std::string_view name);

// Takes the rows of `element` off `body` and returns columns `wanted` (property
// numbers of scalars) as one row-major table. kDataLoss if there are fewer
// bytes than the element's count needs, which is found out before any memory is
// taken for it, or if something is not a number.
Result<std::vector<double>> TakePlyRows(const PlyElement& element,
                                        PlyFormat format,
                                        const std::vector<std::size_t>& wanted,
                                        std::string_view& body);

}  // namespace curvix
