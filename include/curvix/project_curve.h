// SPDX-License-Identifier: BSD-3-Clause
// Curves in the images of views.
#pragma once

#include <curvix/curves.h>
#include <curvix/scene.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace curvix {

// The pixel of the view's image, distortion included, at which `point` is seen.
// nullopt: behind the camera, more than 80 degrees off its axis, where the
// camera model is not one-to-one, or outside the image.
std::optional<Eigen::Vector2d> ProjectPoint(const Eigen::Vector3d& point,
                                            const View& view,
                                            const Camera& camera);

// The stretches of two or more successive samples of `curve` that the view
// could see, in pixels; the closing segment included. What surfaces hide is
// not left out.
std::vector<std::vector<Eigen::Vector2d>> ProjectCurve(const Curve& curve,
                                                       const View& view,
                                                       const Camera& camera);

}  // namespace curvix
