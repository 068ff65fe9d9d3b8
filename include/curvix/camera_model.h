// SPDX-License-Identifier: BSD-3-Clause
// COLMAP's camera models, both ways.
//
// u = X/Z and v = Y/Z are ideal image coordinates. The ideal pinhole of a
// camera has its focal lengths and principal point and no distortion: it is the
// image plane in which all later stages work.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>

#include <Eigen/Core>
#include <optional>
#include <string_view>

namespace curvix {

// The number of parameters of `model`.
int NumParams(CameraModel model);

// COLMAP's name of `model`, "SIMPLE_RADIAL" say, and back. nullopt: unknown.
std::string_view ModelName(CameraModel model);
std::optional<CameraModel> ModelFromName(std::string_view name);
std::optional<CameraModel> ModelFromId(int colmap_model_id);

// kInvalidArgument unless size, parameter count and values make a camera:
// positive size, finite parameters, positive focal lengths.
Status Validate(const Camera& camera);

// The ideal pinhole's calibration matrix.
Eigen::Matrix3d PinholeCalibration(const Camera& camera);

// Whether the model is its own ideal pinhole (PINHOLE, SIMPLE_PINHOLE).
bool IsPinhole(const Camera& camera);

// The pixel at which the direction (u, v, 1) is seen.
Eigen::Vector2d ImageFromIdeal(const Camera& camera, const Eigen::Vector2d& uv);

// The direction (u, v, 1) seen at `pixel`: Newton's method on the distortion.
// nullopt where it does not converge to within 1e-6 px, or where the direction
// is more than 80 degrees off the optical axis.
std::optional<Eigen::Vector2d> IdealFromImage(const Camera& camera,
                                              const Eigen::Vector2d& pixel);

// d ImageFromIdeal / d(u, v).
Eigen::Matrix2d ImageFromIdealJacobian(const Camera& camera,
                                       const Eigen::Vector2d& uv);

}  // namespace curvix
