// SPDX-License-Identifier: BSD-3-Clause
// COLMAP's reconstructions as scenes.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <filesystem>
#include <string>
#include <vector>

namespace curvix {

// Reads the sparse model of a COLMAP workspace and finds its images:
//   <workspace>/images/             images, or `image_path` if it is given
//   <workspace>/sparse/<k>, sparse  the model, .bin or .txt, of COLMAP 3.6 to
//                                   4.x; of several the one with most images
//   <workspace>/dense/<k>/          undistorted images and their model
// The workspace may also be the folder of the model itself. The scene has the
// views whose images are there, sorted by name. Cameras are scaled to images of
// another size but the same proportions, of which headers are read. `notes`
// takes sentences worth telling a user: images that are missing, models that
// were not taken, cameras that were scaled. Poses are as the model has them:
// RefinePosesWithCurves (refine_poses.h) refines them. kNotFound: no folder, no
// model, or fewer than three of its images are there. kDataLoss: a broken
// model. kUnsupported: its camera model. kInvalidArgument: a model of fewer
// than three images.
Result<Scene> ReadColmapScene(const std::filesystem::path& workspace_path,
                              const std::filesystem::path& image_path = {},
                              std::vector<std::string>* notes = nullptr);

}  // namespace curvix
