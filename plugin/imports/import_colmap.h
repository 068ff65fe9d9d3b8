// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#pragma once

#include "plugin/imports/import_scene.h"

namespace curvix {

// A COLMAP model (.bin or .txt, options.input_path) and the folder of its
// images (options.image_path, must be given), wherever they are: the parts of a
// workspace. Ids, cameras, 2D and 3D points are kept. kNotFound if an image of
// the model is not in the folder, kDataLoss if one has another size than its
// camera.
Result<ImportedScene> ImportColmapImages(const ImportOptions& options);

}  // namespace curvix
