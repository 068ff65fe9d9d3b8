// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The DTU multi-view set, in two forms.
#pragma once

#include "plugin/imports/import_scene.h"

namespace curvix {

// options.input_path is one of
//  * cameras*.npz of IDR, NeuS and their successors, or the folder that holds
//    one: world_mat_<i>, 4 x 4, whose first three rows are K [R | t] of the
//    i-th image. In millimetres and DTU's frame, or, with
//    options.normalize, those of scale_mat_<i>, where the object is in the unit
//    sphere. Images are looked for in image/, images/ and beside the file.
//    Their order by name is that of i; if their number is another, the first
//    number in a name is i.
//  * a folder with the original set's pos_<n>.txt, each 3 x 4: K [R | t] in
//    millimetres. The first number in an image's name is n. Positions
//    without images are left out (a calibration has 64 of them, most scans
//    49), with a note.
// The centre of the first pixel counts as (0, 0). K is shared by all views if
// it agrees to within 0.02 px, as it does up to rounding.
Result<ImportedScene> ImportDtu(const ImportOptions& options);

}  // namespace curvix
