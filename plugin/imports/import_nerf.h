// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
// transforms.json, as NeRF (Blender), instant-ngp, nerfstudio and ABC-NEF write
// it.
#pragma once

#include "plugin/imports/import_scene.h"

namespace curvix {

// Reads options.input_path, or transforms.json, failing that
// transforms_train.json, of that folder.
//
// Poses: transform_matrix, world_from_cam with OpenGL's axes (y up, z
// backward), 4 x 4 or 3 x 4; a scale common to its axes is taken out of them.
//
// Cameras: what a frame says wins over what the file says. The first of these
// that is there, with the centre of the first pixel in the source:
//   camera_intrinsics       3 x 3 (ABC-NEF)                           (0, 0)
//   fl_x, fl_y, cx, cy      (instant-ngp, nerfstudio)             (0.5, 0.5)
//   camera_angle_x, _y      full angles of view in radians (Blender)
// fl_y falls back on fl_x, cx and cy on the middle of the image. With k1, k2,
// p1, p2 the camera is OPENCV, with k3 FULL_OPENCV, with camera_model
// OPENCV_FISHEYE or is_fisheye OPENCV_FISHEYE (k1 to k4). w and h, where given,
// must be the size of the image.
//
// Images: file_path, with or without an extension, below the file's folder
// or below options.image_path; there also by its last part alone, since the
// folders of file_path are often those of another machine.
//
// kNotFound: images that are not there. kDataLoss: not such a file.
// kUnsupported: another camera model.
Result<ImportedScene> ImportNerf(const ImportOptions& options);

}  // namespace curvix
