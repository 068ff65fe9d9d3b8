// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/projection_matrix.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <string>

namespace curvix {
namespace {

// Upper triangular times orthogonal, the diagonal positive.
struct RqFactors {
  Eigen::Matrix3d upper;
  Eigen::Matrix3d orthogonal;
};

RqFactors FactorRq(const Eigen::Matrix3d& matrix) {
  // With J turning the order of the rows around: (J M)' = Q U, so that
  // M = (J U' J) (J Q').
  const Eigen::Matrix3d flipped = matrix.colwise().reverse().transpose();
  const Eigen::HouseholderQR<Eigen::Matrix3d> qr(flipped);
  const Eigen::Matrix3d q = qr.householderQ();
  const Eigen::Matrix3d u = qr.matrixQR().triangularView<Eigen::Upper>();
  RqFactors factors;
  factors.upper = u.transpose().reverse();
  factors.orthogonal = q.transpose().colwise().reverse();
  for (int i = 0; i < 3; ++i) {
    if (factors.upper(i, i) >= 0) continue;
    factors.upper.col(i) *= -1;
    factors.orthogonal.row(i) *= -1;
  }
  return factors;
}

Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

}  // namespace

std::optional<CalibratedPose> DecomposeProjection(const Matrix34d& projection) {
  const double scale = projection.leftCols<3>().cwiseAbs().maxCoeff();
  if (!projection.allFinite() || !(scale > 0)) return std::nullopt;
  Matrix34d scaled = projection / scale;
  const double determinant = scaled.leftCols<3>().determinant();
  if (!(std::abs(determinant) > 1e-14)) return std::nullopt;
  if (determinant < 0) scaled = -scaled;
  const RqFactors factors = FactorRq(scaled.leftCols<3>());
  CalibratedPose result;
  result.calibration = factors.upper / factors.upper(2, 2);
  result.cam_from_world = PoseOfProjection(scaled, result.calibration);
  if (!result.cam_from_world.translation.allFinite()) return std::nullopt;
  return result;
}

Rigid3 PoseOfProjection(const Matrix34d& projection,
                        const Eigen::Matrix3d& calibration) {
  const Matrix34d metric = calibration.inverse() * projection;
  const double scale = std::cbrt(metric.leftCols<3>().determinant());
  Rigid3 pose;
  pose.rotation =
      Eigen::Quaterniond(NearestRotation(metric.leftCols<3>() / scale));
  pose.rotation.normalize();
  // The place of the camera is kept exactly, whatever turned it a little.
  const Eigen::Vector3d center =
      -metric.leftCols<3>().inverse() * metric.col(3);
  pose.translation = pose.rotation * -center;
  return pose;
}

std::optional<Eigen::Quaterniond> RotationFromMatrix(
    const Eigen::Matrix3d& matrix) {
  constexpr double kTolerance = 1e-3;
  const double scale = std::cbrt(matrix.determinant());
  if (!matrix.allFinite() || !(scale > 0)) return std::nullopt;
  const Eigen::Matrix3d unit = matrix / scale;
  const Eigen::Matrix3d rotation = NearestRotation(unit);
  if (!((unit - rotation).norm() < kTolerance)) return std::nullopt;
  return Eigen::Quaterniond(rotation).normalized();
}

Result<Camera> CameraFromCalibration(const Eigen::Matrix3d& calibration,
                                     int width,
                                     int height,
                                     double first_pixel) {
  constexpr double kMaxSkewPx = 0.05;
  const Eigen::Matrix3d k = calibration / calibration(2, 2);
  constexpr double kRounding = 1e-6;
  if (!k.allFinite() || k.row(2).head<2>().norm() > kRounding ||
      std::abs(k(1, 0)) > kRounding * k.cwiseAbs().maxCoeff()) {
    return Status::DataLoss(
        "the calibration matrix is not upper triangular and finite");
  }
  const double skew_px = std::abs(k(0, 1) / k(1, 1)) * height / 2;
  if (!(skew_px <= kMaxSkewPx)) {
    return Status::Unsupported(
        "the calibration matrix has skew, " + std::to_string(skew_px) +
        " px at the border, and COLMAP's cameras have none");
  }
  const double shift = 0.5 - first_pixel;
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.params = {k(0, 0), k(1, 1), k(0, 2) + shift, k(1, 2) + shift};
  const Status status = Validate(camera);
  if (!status.ok()) return Status::DataLoss(status.message());
  return camera;
}

}  // namespace curvix
