// SPDX-License-Identifier: BSD-3-Clause
// COLMAP's camera models, both ways: ids 0 to 16, with COLMAP's formulas.
// EQUIRECTANGULAR (17) has no pinhole image and is not supported.
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

// The number of parameters of `model`. Here and in ModelName, `model` is one of
// the enumerators.
int NumParams(CameraModel model);

// COLMAP's name of `model`, "SIMPLE_RADIAL" say, and back. nullopt: unknown.
std::string_view ModelName(CameraModel model);
std::optional<CameraModel> ModelFromName(std::string_view name);
std::optional<CameraModel> ModelFromId(int colmap_model_id);

// kInvalidArgument unless size, parameter count and values make a camera:
// positive size, finite parameters, positive focal lengths; FOV: |omega| < pi;
// EUCM: 0 <= alpha <= 1 and beta > 0. The functions below need a valid camera.
Status Validate(const Camera& camera);

// The ideal pinhole's calibration matrix.
Eigen::Matrix3d PinholeCalibration(const Camera& camera);

// Whether the model is its own ideal pinhole (PINHOLE, SIMPLE_PINHOLE).
bool IsPinhole(const Camera& camera);

// The pixel at which the direction (u, v, 1) is seen. NaN where the camera has
// no image of it (the division models with k > 0, beyond 4 k (u^2 + v^2) = 1).
// Far outside the image, polynomial models fold over and the pixel means
// nothing; IdealFromImage(ImageFromIdeal(uv)) != uv tells.
Eigen::Vector2d ImageFromIdeal(const Camera& camera, const Eigen::Vector2d& uv);

// The direction (u, v, 1) seen at `pixel`: Newton's method on the distortion,
// started at the undistorted guess and kept where the model is one-to-one (its
// Jacobian's determinant positive). nullopt where it does not converge to
// within 1e-6 px, or where the direction is more than 80 degrees off the
// optical axis.
std::optional<Eigen::Vector2d> IdealFromImage(const Camera& camera,
                                              const Eigen::Vector2d& pixel);

// d ImageFromIdeal / d(u, v), exact; [pixels per unit of (u, v)].
Eigen::Matrix2d ImageFromIdealJacobian(const Camera& camera,
                                       const Eigen::Vector2d& uv);

// Where a camera at `cam_from_world` sees `position`; nullopt behind the camera
// and where it has no image of it.
std::optional<Eigen::Vector2d> Project(const Camera& camera,
                                       const Rigid3& cam_from_world,
                                       const Eigen::Vector3d& position);

// A point in an image.
struct PointInImage {
  const Camera* camera = nullptr;  // not null
  Rigid3 cam_from_world;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// The position whose projections fit best, with Cauchy's loss of scale 1 px:
// Gauss-Newton steps from `start`, as long as they help; `start` where none
// does.
Eigen::Vector3d FitPoint(const Eigen::Vector3d& start,
                         const std::vector<PointInImage>& seen);

}  // namespace curvix
