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

struct PlyScalar;  // a type of numbers

struct PlyProperty {
  std::string name;
  const PlyScalar* type = nullptr;  // of the scalar, or of the list's items
  const PlyScalar* count_type = nullptr;  // null: no list
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

// The scalar properties of `element` with these names, by their numbers;
// nothing if one is missing.
std::optional<std::vector<std::size_t>> FindScalars(
    const PlyElement& element, const std::vector<std::string_view>& names);

// Takes the rows of `element` off `body` and returns columns `wanted` (property
// numbers of scalars) as one row-major table. kDataLoss if there are fewer
// bytes than the element's count needs, which is found out before any memory is
// taken for it, or if something is not a number.
Result<std::vector<double>> TakePlyRows(const PlyElement& element,
                                        PlyFormat format,
                                        const std::vector<std::size_t>& wanted,
                                        std::string_view& body);

}  // namespace curvix
