// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "geometry/rim.h"

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>

#include "geometry/directions.h"

namespace curvix {
namespace {

constexpr int kNumIterations = 3;
// In measurements: keep the system regular, the radius before the place.
constexpr double kPriorOfPlace = 1e-8;
constexpr double kPriorOfRadius = 1e-5;

Eigen::Vector3d AcrossAxisAndRay(const SpaceEdge& axis,
                                 const Eigen::Vector3d& center) {
  return axis.tangent.cross(axis.position - center).normalized();
}

// The mean of the sides that the views see, of which each is known up to sign.
Eigen::Vector3d Outward(const SpaceEdge& axis,
                        const std::vector<PlaneMeasurement>& measurements) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const PlaneMeasurement& m : measurements) {
    const Eigen::Vector3d side = AcrossAxisAndRay(axis, m.center);
    scatter += side * side.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(scatter);
  return solver.eigenvectors().col(2);
}

// The radius if the axis may move across itself, too.
double FitRadius(const Rim& rim,
                 const std::vector<PlaneMeasurement>& measurements,
                 double sigma_px) {
  const AcrossAxes across = AxesAcross(rim.axis.tangent);
  const auto count = static_cast<Eigen::Index>(measurements.size());
  Eigen::MatrixX3d rows(count, 3);
  Eigen::VectorXd distances(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const PlaneMeasurement& m = measurements[static_cast<std::size_t>(i)];
    const SeenDistance seen = DistanceFrom(m, rim.axis.position);
    rows.row(i) << seen.gradient.transpose() * across,
        seen.gradient.dot(SideSeenFrom(rim, m.center));
    distances(i) = seen.px;
  }
  Eigen::Vector3d solution(0, 0, rim.radius);
  for (int iteration = 0; iteration < kNumIterations; ++iteration) {
    const Eigen::VectorXd weights =
        (distances + rows * solution).unaryExpr([sigma_px](double residual) {
          return CauchyWeight(residual, sigma_px);
        });
    Eigen::Matrix3d matrix = rows.transpose() * weights.asDiagonal() * rows;
    matrix.diagonal() +=
        matrix.trace() / static_cast<double>(count) *
        Eigen::Vector3d(kPriorOfPlace, kPriorOfPlace, kPriorOfRadius);
    solution = matrix.inverse() *
               -(rows.transpose() * weights.asDiagonal() * distances);
  }
  return solution.z();
}

}  // namespace

Eigen::Vector3d MiddleOf(const Rim& rim) {
  return rim.axis.position + rim.radius * rim.outward;
}

Eigen::Vector3d SideSeenFrom(const Rim& rim, const Eigen::Vector3d& center) {
  const Eigen::Vector3d side = AcrossAxisAndRay(rim.axis, center);
  return side.dot(rim.outward) < 0 ? -side : side;
}

SpaceEdge SeenFrom(const Rim& rim, const Eigen::Vector3d& center) {
  return {rim.axis.position + rim.radius * SideSeenFrom(rim, center),
          rim.axis.tangent};
}

Rim AdjustRim(const Rim& start,
              const std::vector<PlaneMeasurement>& measurements,
              double sigma_px) {
  Rim rim = start;
  rim.outward = Outward(rim.axis, measurements);
  if (rim.outward.dot(start.outward) < 0) rim.outward = -rim.outward;
  rim.radius = FitRadius(rim, measurements, sigma_px);
  // A camera sees the rim where one that stands beside it would see the axis.
  std::vector<PlaneMeasurement> of_axis = measurements;
  for (PlaneMeasurement& m : of_axis) {
    m.center -= rim.radius * SideSeenFrom(rim, m.center);
  }
  rim.axis = AdjustEdge(rim.axis, of_axis, sigma_px).edge;
  return rim;
}

}  // namespace curvix
