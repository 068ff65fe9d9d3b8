// SPDX-License-Identifier: BSD-3-Clause
#include "base/image_header.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>

namespace curvix {
namespace {

using std::string_view_literals::operator""sv;

// The bytes of a file, of which those around a place are read when it is asked
// for.
class FileBytes {
 public:
  explicit FileBytes(const std::filesystem::path& path)
      : stream_(path, std::ios::binary) {
    stream_.seekg(0, std::ios::end);
    const std::streamoff end = stream_.tellg();
    size_ = end > 0 ? static_cast<std::size_t>(end) : 0;
  }

  std::size_t size() const { return size_; }
  // 0 where the file cannot be read.
  char operator[](std::size_t at) const {
    constexpr std::size_t kBlock = 4096;
    if (at / kBlock != block_) {
      block_ = at / kBlock;
      bytes_.assign(kBlock, 0);
      stream_.clear();
      stream_.seekg(static_cast<std::streamoff>(block_ * kBlock));
      stream_.read(bytes_.data(), kBlock);
    }
    return bytes_[at % kBlock];
  }

 private:
  mutable std::ifstream stream_;
  mutable std::vector<char> bytes_;  // of the block
  mutable std::size_t block_ = std::numeric_limits<std::size_t>::max();
  std::size_t size_ = 0;
};

// The functions below take `bytes` as a string_view or as FileBytes.

template <typename Bytes>
bool StartsWith(const Bytes& bytes, std::string_view start) {
  if (bytes.size() < start.size()) return false;
  for (std::size_t i = 0; i < start.size(); ++i) {
    if (bytes[i] != start[i]) return false;
  }
  return true;
}

std::optional<ImageHeader> Checked(std::uint32_t width,
                                   std::uint32_t height,
                                   std::uint32_t bits) {
  constexpr std::uint32_t kMax = 1u << 20;
  if (width == 0 || height == 0 || width > kMax || height > kMax) {
    return std::nullopt;
  }
  return ImageHeader{{static_cast<int>(width), static_cast<int>(height)},
                     static_cast<int>(bits)};
}

// The number in the `size` bytes at `at`; zero beyond the end.
template <typename Bytes>
std::uint32_t NumberAt(const Bytes& bytes,
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
template <typename Bytes, typename Visit>
void VisitSegments(const Bytes& bytes, const Visit& visit) {
  std::size_t at = 2;
  while (at + 1 < bytes.size()) {
    const std::uint32_t marker =
        bytes[at] == '\xFF' ? NumberAt(bytes, at + 1, 1) : 0;
    // Coded data, stuffing, restart markers.
    if (marker < 0xC0 || marker == 0xFF || (marker & 0xF8) == 0xD0) {
      ++at;
      continue;
    }
    at += 2;
    if (!visit(marker, at) || at + 1 >= bytes.size()) return;
    at += NumberAt(bytes, at, 2);
  }
}

template <typename Bytes>
bool IsJpeg(const Bytes& bytes) {
  return bytes.size() >= 4 && StartsWith(bytes, "\xFF\xD8"sv);
}

template <typename Bytes>
std::optional<ImageHeader> HeaderOfJpeg(const Bytes& bytes) {
  std::optional<ImageHeader> header;
  VisitSegments(bytes, [&](std::uint32_t marker, std::size_t at) {
    if (!IsJpegFrame(marker)) return marker != kJpegEnd;
    // Behind the length.
    header = Checked(NumberAt(bytes, at + 5, 2),
                     NumberAt(bytes, at + 3, 2),
                     NumberAt(bytes, at + 2, 1));
    return false;
  });
  return header;
}

// Calls visit(tag, place) for the entries of the first directory of a TIFF: a
// tag, a type, a count and a value of four bytes, of which short numbers take
// the first two. Of several, which do not fit, it is the place.
template <typename Bytes, typename Visit>
void VisitEntries(const Bytes& bytes, bool is_big, const Visit& visit) {
  const std::size_t directory = NumberAt(bytes, 4, 4, is_big);
  const std::uint32_t count = NumberAt(bytes, directory, 2, is_big);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t at = directory + 2 + 12 * std::size_t{i};
    visit(NumberAt(bytes, at, 2, is_big), at);
  }
}

template <typename Bytes>
std::optional<ImageHeader> HeaderOfTiff(const Bytes& bytes, bool is_big) {
  constexpr std::uint32_t kWidth = 256, kHeight = 257, kBits = 258, kShort = 3;
  std::uint32_t width = 0, height = 0, bits = 1;
  VisitEntries(bytes, is_big, [&](std::uint32_t tag, std::size_t at) {
    const bool is_short = NumberAt(bytes, at + 2, 2, is_big) == kShort;
    const std::uint32_t value =
        NumberAt(bytes, at + 8, is_short ? 2 : 4, is_big);
    if (tag == kWidth) width = value;
    if (tag == kHeight) height = value;
    if (tag != kBits) return;
    const bool is_apart = is_short && NumberAt(bytes, at + 4, 4, is_big) > 2;
    bits = is_apart
               ? NumberAt(bytes, NumberAt(bytes, at + 8, 4, is_big), 2, is_big)
               : value;
  });
  return Checked(width, height, bits);
}

constexpr std::string_view kLittleTiff = "II*\0"sv, kBigTiff = "MM\0*"sv;

// The height is below 0 where the first row comes first.
template <typename Bytes>
std::optional<ImageHeader> HeaderOfBmp(const Bytes& bytes) {
  constexpr std::uint32_t kShortHeader = 12;  // bytes; sides have two each
  if (NumberAt(bytes, 14, 4, false) == kShortHeader) {
    return Checked(
        NumberAt(bytes, 18, 2, false), NumberAt(bytes, 20, 2, false), 8);
  }
  const std::uint32_t height = NumberAt(bytes, 22, 4, false);
  return Checked(
      NumberAt(bytes, 18, 4, false), std::min(height, 0 - height), 8);
}

// PBM, PGM and PPM: "P6" and the sides as text, with comments from "#" to the
// end of the line.
template <typename Bytes>
std::optional<ImageHeader> HeaderOfPnm(const Bytes& bytes) {
  constexpr std::uint32_t kTooLarge = 1u << 24;
  std::size_t at = 2;
  const auto next = [&] {
    bool is_comment = false;
    for (; at < bytes.size(); ++at) {
      is_comment = is_comment ? bytes[at] != '\n' : bytes[at] == '#';
      if (!is_comment && " \t\r\n"sv.find(bytes[at]) == ""sv.npos) break;
    }
    std::uint32_t number = 0;
    for (; at < bytes.size() && number < kTooLarge; ++at) {
      const auto digit = static_cast<std::uint32_t>(bytes[at] - '0');
      if (digit > 9) break;
      number = 10 * number + digit;
    }
    return number;
  };
  const std::uint32_t width = next();
  std::optional<ImageHeader> header = Checked(width, next(), 8);
  const bool is_bitmap = bytes[1] == '1' || bytes[1] == '4';
  if (header && !is_bitmap) header->max_value = static_cast<int>(next());
  return header;
}

template <typename Bytes>
std::optional<ImageHeader> Header(const Bytes& bytes) {
  if (StartsWith(bytes, "\x89PNG\r\n\x1a\n"sv)) {
    return Checked(
        NumberAt(bytes, 16, 4), NumberAt(bytes, 20, 4), NumberAt(bytes, 24, 1));
  }
  if (IsJpeg(bytes)) return HeaderOfJpeg(bytes);
  if (StartsWith(bytes, kLittleTiff)) return HeaderOfTiff(bytes, false);
  if (StartsWith(bytes, kBigTiff)) return HeaderOfTiff(bytes, true);
  if (StartsWith(bytes, "BM"sv)) return HeaderOfBmp(bytes);
  if (StartsWith(bytes, "P"sv) && bytes.size() > 1 && bytes[1] >= '1' &&
      bytes[1] <= '6') {
    return HeaderOfPnm(bytes);
  }
  return std::nullopt;
}

}  // namespace

bool HaveSameShape(const ImageSize& a, const ImageSize& b) {
  const double x = a.width / static_cast<double>(b.width);
  const double y = a.height / static_cast<double>(b.height);
  return std::abs(x * b.height - a.height) <= std::max({1.0, x, y});
}

std::optional<ImageHeader> HeaderOf(std::string_view bytes) {
  return Header(bytes);
}

std::optional<ImageHeader> ReadImageHeader(const std::filesystem::path& path) {
  return Header(FileBytes(path));
}

void IgnoreTiffOrientation(std::vector<std::uint8_t>* bytes) {
  constexpr std::uint32_t kOrientation = 274;
  const std::string_view view(reinterpret_cast<const char*>(bytes->data()),
                              bytes->size());
  const bool is_big = StartsWith(view, kBigTiff);
  if (!is_big && !StartsWith(view, kLittleTiff)) return;
  VisitEntries(view, is_big, [&](std::uint32_t tag, std::size_t at) {
    if (tag != kOrientation || at + 10 > bytes->size()) return;
    (*bytes)[at + 8] = is_big ? 0 : 1;
    (*bytes)[at + 9] = is_big ? 1 : 0;
  });
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
