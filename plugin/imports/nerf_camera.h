// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "edge_detection/image_header.h"

namespace curvix {

// The camera of a frame of a transforms.json, both of which are JSON objects,
// as ImportNerf explains. `first_pixel` wins over the convention of the source.
// Errors are parts of a sentence: "camera_model is EQUIRECTANGULAR, ...".
Result<Camera> NerfCamera(const nlohmann::json& frame,
                          const nlohmann::json& file,
                          const ImageSize& image,
                          std::optional<double> first_pixel);

// "transform_matrix" of `frame` as cam_from_world with COLMAP's axes. kDataLoss
// if there is none, or if it is not a similarity transform.
Result<Rigid3> NerfPose(const nlohmann::json& frame);

}  // namespace curvix
