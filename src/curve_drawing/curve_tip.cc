// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/curve_tip.h"

#include <Eigen/Dense>
#include <cmath>

#include "base/angles.h"

namespace curvix {
namespace {

// Of the random walk of the direction, after a pixel.
constexpr double kBendSigmaRad = 0.04;
constexpr double kTangentSigmaRad = DegToRad(4);
// Errors of edges are correlated along a contour: so many pixels are one
// measurement.
constexpr double kCorrelatedPx = 3;
// Of the direction of a seed, where its edges do not determine it.
constexpr double kSeedSlopeSigma = 0.3;
// Where cameras move along an edge, its planes nearly coincide, and images
// hardly tell how it runs in depth. Edges seen end-on are short in images, and
// so rare: directions across the rays are preferred, as strongly as by planes
// whose normals deviate by 13 degrees (root mean square).
constexpr double kSeedRayWeight = 0.05;

}  // namespace

CurveTip::CurveTip(const SpaceEdge& edge,
                   const std::vector<PlaneMeasurement>& measurements,
                   double sigma_px,
                   double pixel)
    : sigma_px_(sigma_px), pixel_(pixel) {
  const EdgeEstimate estimate =
      AdjustEdge(edge, measurements, sigma_px, kSeedRayWeight);
  edge_ = estimate.edge;
  axes_ = estimate.across;
  covariance_.topLeftCorner<2, 2>() = estimate.covariance / (pixel * pixel);
  Eigen::Matrix2d slopes =
      Eigen::Matrix2d::Identity() / (kSeedSlopeSigma * kSeedSlopeSigma);
  for (const PlaneMeasurement& m : measurements) {
    const Eigen::Vector2d n = axes_.transpose() * m.plane.normalized();
    slopes += n * n.transpose() / (kTangentSigmaRad * kTangentSigmaRad);
  }
  covariance_.bottomRightCorner<2, 2>() = slopes.inverse();
}

void CurveTip::Reverse() {
  edge_.tangent = -edge_.tangent;
  covariance_.topRightCorner<2, 2>() *= -1;
  covariance_.bottomLeftCorner<2, 2>() *= -1;
}

void CurveTip::Step(double step_px) {
  edge_.position += step_px * pixel_ * edge_.tangent;
  Eigen::Matrix4d move = Eigen::Matrix4d::Identity();
  move.topRightCorner<2, 2>() = step_px * Eigen::Matrix2d::Identity();
  covariance_ = move * covariance_ * move.transpose();
  const double variance = kBendSigmaRad * kBendSigmaRad * step_px;
  for (int i = 0; i < 2; ++i) {
    covariance_(i, i) += variance * step_px * step_px / 3;
    covariance_(i, i + 2) += variance * step_px / 2;
    covariance_(i + 2, i) += variance * step_px / 2;
    covariance_(i + 2, i + 2) += variance;
  }
}

void CurveTip::Correct(const std::vector<PlaneMeasurement>& measurements) {
  Eigen::Matrix4d information = covariance_.inverse();
  Eigen::Vector4d vector = Eigen::Vector4d::Zero();
  const auto add =
      [&](const Eigen::Vector4d& row, double innovation, double sigma) {
        // Cauchy's weight, against what may be expected.
        const double expected = row.dot(covariance_ * row) + sigma * sigma;
        const double r2 = innovation * innovation / expected;
        const double weight = 1 / (kCorrelatedPx * sigma * sigma * (1 + r2));
        information += weight * row * row.transpose();
        vector += weight * innovation * row;
      };
  for (const PlaneMeasurement& m : measurements) {
    const SeenDistance distance = DistanceFrom(m, edge_.position);
    Eigen::Vector4d row = Eigen::Vector4d::Zero();
    row.head<2>() = pixel_ * axes_.transpose() * distance.gradient;
    add(row, -distance.px, sigma_px_);
    const Eigen::Vector3d normal = m.plane.normalized();
    row.setZero();
    row.tail<2>() = axes_.transpose() * normal;
    add(row, -normal.dot(edge_.tangent), kTangentSigmaRad);
  }
  const Eigen::Matrix4d covariance = information.inverse();
  if (!covariance.allFinite()) return;
  covariance_ = (covariance + covariance.transpose()) / 2;
  FoldIn(covariance_ * vector);
}

// The axes turn with the tangent, on the side on which they are.
void CurveTip::FoldIn(const Eigen::Vector4d& change) {
  edge_.position += pixel_ * axes_ * change.head<2>();
  const Eigen::Vector3d before = edge_.tangent;
  edge_.tangent = (before + axes_ * change.tail<2>()).normalized();
  axes_ = ShortestRotation(before, edge_.tangent).toRotationMatrix() * axes_;
}

double CurveTip::VarianceIn(const PosedView& view,
                            const ImageEdge& projected) const {
  const Eigen::Matrix2d covariance = covariance_.topLeftCorner<2, 2>();
  return VarianceAcross(
      view, projected, {edge_, axes_, pixel_ * pixel_ * covariance});
}

double CurveTip::Sigma() const {
  return pixel_ * std::sqrt(covariance_.topLeftCorner<2, 2>().trace() / 2);
}

}  // namespace curvix
