// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Models whose images are there in another size.
#pragma once

#include <filesystem>
#include <string>

#include "colmap/colmap_model.h"

namespace curvix {

// Scales cameras and 2D points of `model` to the images in `folder`, if these
// are copies of those it was made of in another size, as images_4/ beside
// images/ in many data sets. Only the headers of images are read (of the
// formats of HeaderOf). A camera is scaled to the size of most of its
// images. It stays as it is if there is no such size, if either side differs
// from the camera's by no more than a pixel, or if no scale of both sides, at
// most 32, gives that size to a pixel of the smaller image. Errors of points
// are not known any more (-1). Returns a sentence for the user, "" if nothing
// was scaled.
std::string ScaleToImages(const std::filesystem::path& folder,
                          ColmapModel* model);

}  // namespace curvix
