// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Models whose images are there in another size.
#pragma once

#include <filesystem>
#include <string>

#include "colmap/colmap_model.h"

namespace curvix {

// Scales cameras and 2D points of `model` to the images in `folder`, if these
// are copies of those it was made of in another size, as images_4/ beside
// images/ in many data sets. The size of a camera's images is that in the
// header of the first of them that is there (of the formats of HeaderOf).
// A camera stays as it is if either side differs by no more than a pixel, and
// if scaling both alike by at most 32 does not give that size, to a pixel of
// the smaller image. Errors of points are not known any more (-1). Returns a
// sentence for the user, "" if nothing was scaled.
std::string ScaleToImages(const std::filesystem::path& folder,
                          ColmapModel* model);

}  // namespace curvix
