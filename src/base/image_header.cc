// SPDX-License-Identifier: BSD-3-Clause
#include "base/image_header.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace curvix {
namespace {

std::optional<ImageSize> Checked(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint32_t kMax = 1u << 20;
  if (width == 0 || height == 0 || width > kMax || height > kMax) {
    return std::nullopt;
  }
  return ImageSize{static_cast<int>(width), static_cast<int>(height)};
}

// The number in the `size` bytes at `at`; zero beyond the end.
std::uint32_t NumberAt(std::string_view bytes,
                       std::size_t at,
                       std::size_t size,
                       bool is_big_endian = true) {
  if (at > bytes.size() || size > bytes.size() - at) return 0;
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const char byte = bytes[is_big_endian ? at + i : at + size - 1 - i];
    number = number << 8 | static_cast<unsigned char>(byte);
  }
  return number;
}

constexpr std::uint32_t kJpegEnd = 0xD9;

bool IsJpegFrame(std::uint32_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 &&
         marker != 0xCC;
}

// Calls visit(marker, place behind it) for each segment of a JPEG until it
// returns false. Segments are skipped by their lengths, since thumbnails inside
// them have markers of their own.
template <typename Visit>
void VisitSegments(std::string_view bytes, const Visit& visit) {
  std::size_t at = 2;
  while (at + 1 < bytes.size()) {
    const std::uint32_t marker = NumberAt(bytes, at + 1, 1);
    const bool is_marker = NumberAt(bytes, at, 1) == 0xFF && marker >= 0xC0 &&
                           marker != 0xFF && (marker & 0xF8) != 0xD0;
    if (!is_marker) {  // coded data, stuffing, restart markers
      ++at;
      continue;
    }
    at += 2;
    if (!visit(marker, at) || at + 1 >= bytes.size()) return;
    at += NumberAt(bytes, at, 2);
  }
}

bool IsJpeg(std::string_view bytes) {
  return bytes.size() >= 4 && bytes.substr(0, 2) == "\xFF\xD8";
}

std::optional<ImageSize> SizeOfJpeg(std::string_view bytes) {
  std::optional<ImageSize> size;
  VisitSegments(bytes, [&](std::uint32_t marker, std::size_t at) {
    if (!IsJpegFrame(marker)) return marker != kJpegEnd;
    // Behind the length and the bits per sample.
    size = Checked(NumberAt(bytes, at + 5, 2), NumberAt(bytes, at + 3, 2));
    return false;
  });
  return size;
}

// From the first directory, whose entries are a tag, a type, a count and a
// value of four bytes, of which short numbers take the first two.
std::optional<ImageSize> SizeOfTiff(std::string_view bytes, bool is_big) {
  constexpr std::uint32_t kWidth = 256, kHeight = 257, kShort = 3;
  const std::size_t directory = NumberAt(bytes, 4, 4, is_big);
  const std::uint32_t count = NumberAt(bytes, directory, 2, is_big);
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t at = directory + 2 + 12 * std::size_t{i};
    const std::uint32_t tag = NumberAt(bytes, at, 2, is_big);
    const bool is_short = NumberAt(bytes, at + 2, 2, is_big) == kShort;
    const std::uint32_t value =
        NumberAt(bytes, at + 8, is_short ? 2 : 4, is_big);
    if (tag == kWidth) width = value;
    if (tag == kHeight) height = value;
  }
  return Checked(width, height);
}

}  // namespace

bool HaveSameShape(const ImageSize& a, const ImageSize& b) {
  const double x = a.width / static_cast<double>(b.width);
  const double y = a.height / static_cast<double>(b.height);
  return std::abs(x * b.height - a.height) <= std::max({1.0, x, y});
}

std::optional<ImageSize> SizeInHeader(std::string_view bytes) {
  using std::string_view_literals::operator""sv;
  if (bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n"sv) {
    return Checked(NumberAt(bytes, 16, 4), NumberAt(bytes, 20, 4));
  }
  if (IsJpeg(bytes)) return SizeOfJpeg(bytes);
  if (bytes.substr(0, 4) == "II*\0"sv) return SizeOfTiff(bytes, false);
  if (bytes.substr(0, 4) == "MM\0*"sv) return SizeOfTiff(bytes, true);
  return std::nullopt;
}

bool IsHeif(std::string_view bytes) {
  // Behind the length of the first box; videos are such files, too.
  return bytes.size() >= 12 && bytes.substr(4, 4) == "ftyp";
}

bool IsTruncatedJpeg(std::string_view bytes) {
  if (!IsJpeg(bytes)) return false;
  bool is_whole = false;
  VisitSegments(bytes, [&](std::uint32_t marker, std::size_t) {
    is_whole = marker == kJpegEnd;
    return !is_whole;
  });
  return !is_whole;
}

}  // namespace curvix
