// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What image files say about themselves, without
// decoding them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace curvix {

struct ImageSize {
  int width = 0;   // pixels
  int height = 0;  // pixels

  friend bool operator==(const ImageSize&, const ImageSize&) = default;
};

// "480 x 320".
inline std::string SizeText(const ImageSize& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

// Whether one is the other, enlarged alike in both directions, to a pixel of
// the smaller one.
bool HaveSameShape(const ImageSize& a, const ImageSize& b);

struct ImageHeader {
  ImageSize size;            // each side at most a million pixels
  int bits_per_channel = 8;  // not read from BMP, PBM, PGM and PPM
  int max_value = 0;         // of PGM and PPM; 0: the largest of these bits
};

// What a PNG, JPEG, TIFF, BMP, PBM, PGM or PPM file announces. nullopt: another
// format, or no sound header.
std::optional<ImageHeader> HeaderOf(std::string_view bytes);

// The same of a file, of which a few kilobytes are read. nullopt, too, if it
// cannot be opened.
std::optional<ImageHeader> ReadImageHeader(const std::filesystem::path& path);

// Sets the orientation of a TIFF to that of its rows: OpenCV turns and mirrors
// others even if it is asked not to. Other files stay as they are.
void IgnoreTiffOrientation(std::vector<std::uint8_t>* bytes);

// Whether a file is HEIF or AVIF, as telephones make them.
bool IsHeif(std::string_view bytes);

// Whether a JPEG lacks its end marker: decoders fill what is missing with grey
// and call it a success.
bool IsTruncatedJpeg(std::string_view bytes);

}  // namespace curvix
