// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Numbers to and from bytes, whatever the byte order
// of the machine.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

namespace curvix {

// Appends the bytes of `value`, least significant first.
template <typename T>
void AppendLittleEndian(T value, std::string& out) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) {
    std::reverse(bytes.begin(), bytes.end());
  }
  out.append(bytes.data(), bytes.size());
}

// The value in the first sizeof(T) bytes, which must be there.
template <typename T>
T LoadBytes(const char* bytes, std::endian order) {
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
  T value;
  std::memcpy(&value, copy.data(), sizeof(T));
  return value;
}

}  // namespace curvix
