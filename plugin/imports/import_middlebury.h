// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
// The multi-view sets of Middlebury: dino and temple, full, ring and sparse
// ring.
#pragma once

#include "plugin/imports/import_scene.h"

namespace curvix {

// Reads <set>_par.txt, options.input_path or the only one in that folder: the
// number of images, then one line for each,
//   name k11 k12 ... k33 r11 r12 ... r33 t1 t2 t3,
// x_cam = R x + t in metres, with COLMAP's axes. Middlebury does not say where
// in the first pixel its origin is; its centre is taken as (0, 0).
// Images are looked for beside the file and in its folder images/.
Result<ImportedScene> ImportMiddlebury(const ImportOptions& options);

}  // namespace curvix
