// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "plugin/similarity.h"

#include <Eigen/SVD>
#include <cmath>

namespace curvix {
namespace {

using Points = Eigen::Matrix3Xd;

// Centres closer together than this share of their distance from the origin
// are at one place: rounding is all that parts them.
constexpr double kCoincident = 1e-10;
// Centres on a line: second over first singular value.
constexpr double kCollinear = 0.02;

Points Centers(const std::vector<Rigid3>& poses) {
  Points centers(3, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    centers.col(static_cast<Eigen::Index>(i)) = poses[i].Inverse().translation;
  }
  return centers;
}

// Singular values of the centred points, descending; zero if they coincide.
Eigen::Vector3d Spread(const Points& points) {
  const Points centered = points.colwise() - points.rowwise().mean();
  const double size = points.cwiseAbs().maxCoeff();
  if (centered.cwiseAbs().maxCoeff() <= kCoincident * size) {
    return Eigen::Vector3d::Zero();
  }
  const Eigen::Matrix3d scatter = centered * centered.transpose();
  return Eigen::JacobiSVD<Eigen::Matrix3d>(scatter)
      .singularValues()
      .cwiseSqrt();
}

bool IsPlaneOrMore(const Eigen::Vector3d& spread) {
  return spread[1] > kCollinear * spread[0];
}

// The rotation nearest to all that turn `from` into `to`, camera by camera.
Eigen::Quaterniond MeanRotation(const std::vector<Rigid3>& from,
                                const std::vector<Rigid3>& to) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    sum += (to[i].rotation.conjugate() * from[i].rotation).toRotationMatrix();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
  const Eigen::Vector3d signs(1, 1, turn.determinant() < 0 ? -1 : 1);
  return Eigen::Quaterniond(Eigen::Matrix3d(svd.matrixU() * signs.asDiagonal() *
                                            svd.matrixV().transpose()));
}

// Rotation and scale of the transformation of the homogeneous `matrix`.
Similarity3 FromMatrix(const Eigen::Matrix4d& matrix) {
  Similarity3 result;
  result.scale = matrix.block<3, 1>(0, 0).norm();
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>() / result.scale;
  result.rotation = Eigen::Quaterniond(rotation).normalized();
  return result;
}

}  // namespace

Rigid3 MovePose(const Similarity3& b_from_a, const Rigid3& cam_from_a) {
  const Eigen::Vector3d center = b_from_a * cam_from_a.Inverse().translation;
  const Eigen::Quaterniond rotation =
      (cam_from_a.rotation * b_from_a.rotation.conjugate()).normalized();
  return {rotation, rotation * -center};
}

std::optional<Similarity3> AlignPoses(const std::vector<Rigid3>& from,
                                      const std::vector<Rigid3>& to) {
  if (from.empty() || from.size() != to.size()) return std::nullopt;
  const Points a = Centers(from);
  const Points b = Centers(to);
  if (!a.allFinite() || !b.allFinite()) return std::nullopt;
  const Eigen::Vector3d spread_a = Spread(a);
  const Eigen::Vector3d spread_b = Spread(b);
  const bool coincide = spread_a[0] == 0 && spread_b[0] == 0;
  if (!coincide && (spread_a[0] == 0 || spread_b[0] == 0)) return std::nullopt;

  const Eigen::Vector3d mean_a = a.rowwise().mean();
  const Eigen::Vector3d mean_b = b.rowwise().mean();
  Similarity3 result;
  if (IsPlaneOrMore(spread_a) && IsPlaneOrMore(spread_b)) {
    result = FromMatrix(Eigen::umeyama(a, b, true));
  } else {
    result.rotation = MeanRotation(from, to);
    const Points turned =
        result.rotation.toRotationMatrix() * (a.colwise() - mean_a);
    const Points target = b.colwise() - mean_b;
    const double product = turned.cwiseProduct(target).sum();
    result.scale = coincide ? 1 : product / turned.squaredNorm();
  }
  result.translation = mean_b - result.scale * (result.rotation * mean_a);
  const bool is_usable = std::isfinite(result.scale) && result.scale > 0 &&
                         result.rotation.coeffs().allFinite() &&
                         result.translation.allFinite();
  if (!is_usable) return std::nullopt;
  return result;
}

}  // namespace curvix
