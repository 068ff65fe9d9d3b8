// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Images to grey levels.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <filesystem>
#include <optional>

#include "base/gray_image.h"
#include "base/image_header.h"

namespace curvix {

// The size of the image as stored (an EXIF rotation is ignored, as COLMAP
// does): from the header (HeaderOf), by decoding files of other formats.
// kNotFound: no such file. kDataLoss: not an image.
Result<ImageSize> ReadImageSize(const std::filesystem::path& path);

// Whether LoadGrayImage() takes the image of a view, as far as its size and the
// header of its file tell, of which a few kilobytes are read: the format and,
// of all but WebP files, size and bits. Its errors.
Status CheckImage(const View& view, const Camera& camera);
// The same of the image and of the mask, LoadMask().
Status CheckImageAndMask(const View& view, const Camera& camera);

// The image of a view: that in memory, if there is one, else that in the file,
// as stored: an EXIF rotation is ignored, as COLMAP does. Grey, colour
// (0.299 R + 0.587 G + 0.114 B) and either with alpha, 8 or 16 bits per
// channel; 16 bits are scaled to 0..255. Fractions are kept: on a clean render,
// rounding grey levels moves one edge in a hundred by more than 0.017 px. Alpha
// is straight and the background black, composited before anything else.
//
// kNotFound: no such file. kDataLoss: the file is empty, broken or cut short.
// kUnsupported: another pixel format. kInvalidArgument: not of the size of the
// camera, which is found out before any but a WebP is decoded; or in memory
// without values, or with a number of channels other than 1, 3 and 4. The
// message names the image.
Result<GrayImage> LoadGrayImage(const View& view, const Camera& camera);

// The mask of a view, if it has one, as its image would be read. One in another
// size takes that of the camera: each pixel the value of the nearest. Errors as
// above; kInvalidArgument: it has another shape than the camera.
Result<std::optional<GrayImage>> LoadMask(const View& view,
                                          const Camera& camera);

}  // namespace curvix
