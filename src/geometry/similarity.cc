// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/similarity.h"

#include <Eigen/SVD>
#include <cmath>

namespace curvix {
namespace {

using Points = Eigen::Matrix3Xd;

// Centres closer together than this share of their distance from the origin
// are at one place: rounding is all that parts them.
constexpr double kCoincident = 1e-10;

Points Centers(const std::vector<Rigid3>& poses) {
  Points centers(3, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    centers.col(static_cast<Eigen::Index>(i)) = poses[i].Inverse().translation;
  }
  return centers;
}

// The points around their mean; all zero if they coincide.
Points Centered(const Points& points) {
  Points centered = points.colwise() - points.rowwise().mean();
  const double size = points.cwiseAbs().maxCoeff();
  if (centered.cwiseAbs().maxCoeff() > kCoincident * size) return centered;
  return Points::Zero(3, points.cols());
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

}  // namespace

Rigid3 MovePose(const Similarity3& b_from_a, const Rigid3& cam_from_a) {
  const Eigen::Vector3d center = b_from_a * cam_from_a.Inverse().translation;
  const Eigen::Quaterniond rotation =
      (cam_from_a.rotation * b_from_a.rotation.conjugate()).normalized();
  return {rotation, rotation * -center};
}

Similarity3 AlignPoints(const Points& from, const Points& to) {
  const Eigen::Matrix4d to_from = Eigen::umeyama(from, to, true);
  Similarity3 result;
  result.scale = to_from.block<3, 1>(0, 0).norm();
  result.rotation = Eigen::Matrix3d(to_from.block<3, 3>(0, 0) / result.scale);
  result.translation = to_from.block<3, 1>(0, 3);
  return result;
}

std::optional<Similarity3> AlignPoses(const std::vector<Rigid3>& from,
                                      const std::vector<Rigid3>& to) {
  if (from.empty() || from.size() != to.size()) return std::nullopt;
  const Points a = Centers(from);
  const Points b = Centers(to);
  if (!a.allFinite() || !b.allFinite()) return std::nullopt;
  const Points centered_a = Centered(a);
  const Points centered_b = Centered(b);
  const bool is_place = centered_a.isZero(0);
  if (is_place != centered_b.isZero(0)) return std::nullopt;

  Similarity3 result;
  result.rotation = MeanRotation(from, to);
  if (!is_place) {
    const Points turned = result.rotation.toRotationMatrix() * centered_a;
    if (!(turned.cwiseProduct(centered_b).sum() > 0)) return std::nullopt;
    result.scale = AlignPoints(centered_a, centered_b).scale;
  }
  const Eigen::Vector3d mean_a = a.rowwise().mean();
  const Eigen::Vector3d mean_b = b.rowwise().mean();
  result.translation = mean_b - result.scale * (result.rotation * mean_a);
  const bool is_usable = std::isfinite(result.scale) && result.scale > 0 &&
                         result.rotation.coeffs().allFinite() &&
                         result.translation.allFinite();
  if (!is_usable) return std::nullopt;
  return result;
}

}  // namespace curvix
