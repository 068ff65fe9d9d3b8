// SPDX-License-Identifier: BSD-3-Clause
// Cameras of a transforms.json.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "edge_detection/load_image.h"
#include "plugin/base/json.h"

namespace curvix {

// The leading rows x cols numbers of a list of lists, which may be longer.
std::optional<Eigen::MatrixXd> ReadMatrix(const Json* rows,
                                          std::size_t num_rows,
                                          std::size_t num_cols);

// The camera of a frame of a transforms.json, both of which are JSON objects,
// as ImportNerf explains. `first_pixel` wins over the convention of the source.
// Errors are parts of a sentence: "camera_model is EQUIRECTANGULAR, ...".
Result<Camera> NerfCamera(const Json& frame,
                          const Json& file,
                          const ImageSize& image,
                          std::optional<double> first_pixel);

}  // namespace curvix
