// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What image files say about themselves.
#pragma once

#include <curvix/image_size.h>

#include <optional>
#include <string_view>

namespace curvix {

// The size that a PNG, JPEG or TIFF file announces, each side at most a million
// pixels. nullopt: another format, or no sound header.
std::optional<ImageSize> SizeInHeader(std::string_view bytes);

// Whether a JPEG lacks its end marker: decoders fill what is missing with grey
// and call it a success.
bool IsTruncatedJpeg(std::string_view bytes);

}  // namespace curvix
