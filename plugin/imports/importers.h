// SPDX-License-Identifier: BSD-3-Clause
// What each format of data sets reads.
#pragma once

#include "plugin/imports/import_scene.h"

namespace curvix {

// A COLMAP model (.bin or .txt, options.input_path) and the folder of its
// images (options.image_path, must be given), wherever they are: the parts of a
// workspace. Ids, cameras, 2D and 3D points are kept. kNotFound if an image of
// the model is not in the folder, kDataLoss if one has another size than its
// camera.
Result<ImportedScene> ImportColmapImages(const ImportOptions& options);

// options.input_path is one of
//  * cameras*.npz of IDR, NeuS and their successors, or the folder that holds
//    one: world_mat_<i>, 4 x 4, whose first three rows are K [R | t] of the
//    i-th image. In millimetres and DTU's frame, or, with
//    options.normalize, those of scale_mat_<i>, where the object is in the unit
//    sphere. Images are looked for in image/, images/ and beside the file. The
//    first numbers in their names are those i if they are the same numbers, or
//    if images and cameras differ in number; else their order by name is that
//    of i.
//  * a folder with the original set's pos_<n>.txt, each 3 x 4: K [R | t] in
//    millimetres. The first number in an image's name is n. Positions
//    without images are left out (a calibration has 64 of them, most scans
//    49), with a note.
// The centre of the first pixel counts as (0, 0). K is shared by all views if
// it agrees to within 0.02 px, as it does up to rounding.
Result<ImportedScene> ImportDtu(const ImportOptions& options);

// Reads <set>_par.txt, options.input_path or the only one in that folder: the
// number of images, then one line for each,
//   name k11 k12 ... k33 r11 r12 ... r33 t1 t2 t3,
// x_cam = R x + t in metres, with COLMAP's axes. Middlebury does not say where
// in the first pixel its origin is; its centre is taken as (0, 0).
// Images are looked for beside the file and in its folder images/.
Result<ImportedScene> ImportMiddlebury(const ImportOptions& options);

// Reads options.input_path, or transforms.json, failing that
// transforms_train.json, of that folder.
//
// Poses: transform_matrix, world_from_cam with OpenGL's axes (y up, z
// backward), 4 x 4 or 3 x 4; a scale common to its axes is taken out of them.
//
// Cameras: what a frame says wins over what the file says, a focal length of
// any kind over one of any other. The first of these that is there, with the
// centre of the first pixel in the source:
//   camera_intrinsics       3 x 3 (ABC-NEF)                           (0, 0)
//   fl_x, fl_y, cx, cy      (instant-ngp, nerfstudio)             (0.5, 0.5)
//   camera_angle_x, _y      full angles of view in radians (Blender)
// fl_y falls back on fl_x of the same object, cx and cy on the middle of the
// image. With k1, k2, p1, p2, or distortion_params (k1 to k4, p1, p2), the
// camera is OPENCV, with k3 FULL_OPENCV, which has k4 to k6 if it is
// camera_model, with camera_model OPENCV_FISHEYE or is_fisheye OPENCV_FISHEYE
// (k1 to k4). w and h, where given, must be the size of the image.
//
// Images: file_path, with or without an extension, below the file's folder
// or below options.image_path; there also without its first folders, since
// those of file_path are often of another machine: the fewest without which it
// is there.
//
// kNotFound: images that are not there. kDataLoss: not such a file.
// kUnsupported: another camera model.
Result<ImportedScene> ImportNerf(const ImportOptions& options);

}  // namespace curvix
