// SPDX-License-Identifier: BSD-3-Clause
// 3 x 4 projection matrices as cameras.
#pragma once

#include <curvix/scene.h>
#include <curvix/status.h>
#include <Eigen/Core>
#include <optional>

namespace curvix {

using Matrix34d = Eigen::Matrix<double, 3, 4>;

// P ~ calibration * [R | t], with an upper triangular calibration whose
// diagonal is positive and ends in 1.
struct CalibratedPose {
  Eigen::Matrix3d calibration = Eigen::Matrix3d::Identity();
  Rigid3 cam_from_world;
};

// The calibration and the pose of `projection`, which is known up to a factor
// of either sign: the sign that makes R a rotation wins. nullopt if a value is
// not finite or if the left 3 x 3 part is singular (no camera at a finite
// place).
std::optional<CalibratedPose> DecomposeProjection(const Matrix34d& projection);

// The pose that, with this `calibration`, comes nearest to `projection`. Both
// as above, `calibration` nearly that of the projection.
Rigid3 PoseOfProjection(const Matrix34d& projection,
                        const Eigen::Matrix3d& calibration);

// The rotation nearest to `matrix`; nullopt unless `matrix` is one, times a
// positive factor, to within 1e-3 of the factor.
std::optional<Eigen::Quaterniond> RotationFromMatrix(
    const Eigen::Matrix3d& matrix);

// The PINHOLE camera of `calibration`, which counts the centre of the first
// pixel as (first_pixel, first_pixel). kUnsupported if its skew moves anything
// in the image by more than a twentieth of a pixel, which COLMAP's cameras do
// not have; kDataLoss if it is not a calibration.
Result<Camera> CameraFromCalibration(const Eigen::Matrix3d& calibration,
                                     int width,
                                     int height,
                                     double first_pixel);

}  // namespace curvix
