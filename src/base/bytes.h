// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Numbers to and from bytes, whatever the byte order
// of the machine.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace curvix {

// Appends the bytes of `value`, least significant first.
template <typename T>
void AppendLittleEndian(T value, std::string& out) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) {
    std::ranges::reverse(bytes);
  }
  out.append(bytes.data(), bytes.size());
}

// The value in the first sizeof(T) bytes, which must be there.
template <typename T>
T LoadBytes(const char* bytes, std::endian order) {
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (order != std::endian::native) std::ranges::reverse(copy);
  return std::bit_cast<T>(copy);
}

template <typename T>
constexpr bool kIsNumber =
    std::is_arithmetic_v<T> || std::is_same_v<T, Eigen::half>;

// Numbers to bytes, least significant first.
class ByteWriter {
 public:
  template <typename T>
  void Put(T value) {
    static_assert(kIsNumber<T>);
    AppendLittleEndian(value, bytes_);
  }
  void PutCount(std::size_t count) { Put(static_cast<std::uint64_t>(count)); }
  // The characters, which hold no NUL, and a NUL.
  void PutName(std::string_view name) {
    bytes_ += name;
    bytes_ += '\0';
  }
  void Reserve(std::size_t num_bytes) { bytes_.reserve(num_bytes); }
  const std::string& bytes() const& { return bytes_; }
  std::string bytes() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Reads what ByteWriter wrote. After a read past the end, ok() is false, and
// this and all later values are zero.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  T Take() {
    static_assert(kIsNumber<T>);
    ok_ = ok_ && bytes_.size() >= sizeof(T);
    if (!ok_) return T{};
    const T value = LoadBytes<T>(bytes_.data(), std::endian::little);
    bytes_.remove_prefix(sizeof(T));
    return value;
  }
  // A count of things of at least `min_bytes` each. Fails if the bytes that are
  // left cannot hold so many.
  std::size_t TakeCount(std::size_t min_bytes) {
    const auto count = Take<std::uint64_t>();
    if (count > bytes_.size() / min_bytes) ok_ = false;
    return ok_ ? static_cast<std::size_t>(count) : 0;
  }
  // The characters up to the next NUL, which is taken, too.
  std::string TakeName() {
    const std::size_t length = bytes_.find('\0');
    if (!ok_ || length == std::string_view::npos) {
      ok_ = false;
      return "";
    }
    std::string name(bytes_.substr(0, length));
    bytes_.remove_prefix(length + 1);
    return name;
  }
  bool ok() const { return ok_; }
  bool AtEnd() const { return ok_ && bytes_.empty(); }
  std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
  bool ok_ = true;
};

}  // namespace curvix
