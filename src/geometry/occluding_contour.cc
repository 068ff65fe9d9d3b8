// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/occluding_contour.h"

#include <Eigen/Dense>
#include <cstddef>

#include "geometry/directions.h"

namespace curvix {
namespace {

constexpr int kNumContourIterations = 3;
// In measurements: keep the system regular, the radius before the place.
constexpr double kPriorOfPlace = 1e-8;
constexpr double kPriorOfRadius = 1e-5;

Eigen::Vector3d AcrossAxisAndRay(const SpaceEdge& axis,
                                 const Eigen::Vector3d& center) {
  return axis.tangent.cross(axis.position - center).normalized();
}

// The radius if the axis may move across itself, too.
double FitRadius(const OccludingContour& contour,
                 const std::vector<PlaneMeasurement>& measurements,
                 double sigma_px) {
  const AcrossAxes across = AxesAcross(contour.axis.tangent);
  const auto count = static_cast<Eigen::Index>(measurements.size());
  Eigen::MatrixX3d rows(count, 3);
  Eigen::VectorXd distances(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const PlaneMeasurement& m = measurements[static_cast<std::size_t>(i)];
    const SeenDistance seen = DistanceFrom(m, contour.axis.position);
    rows.row(i) << seen.gradient.transpose() * across,
        seen.gradient.dot(SideSeenFrom(contour, m.center));
    distances(i) = seen.px;
  }
  Eigen::Vector3d solution(0, 0, contour.radius);
  for (int iteration = 0; iteration < kNumContourIterations; ++iteration) {
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

Eigen::Vector3d MiddleOf(const OccludingContour& contour) {
  return contour.axis.position + contour.radius * contour.outward;
}

Eigen::Vector3d SideSeenFrom(const OccludingContour& contour,
                             const Eigen::Vector3d& center) {
  const Eigen::Vector3d side = AcrossAxisAndRay(contour.axis, center);
  return side.dot(contour.outward) < 0 ? -side : side;
}

Eigen::Vector3d MeanSide(const SpaceEdge& axis,
                         const std::vector<Eigen::Vector3d>& centers) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& center : centers) {
    const Eigen::Vector3d side = AcrossAxisAndRay(axis, center);
    scatter += side * side.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(scatter);
  return solver.eigenvectors().col(2);
}

SpaceEdge SeenFrom(const OccludingContour& contour,
                   const Eigen::Vector3d& center) {
  return {
      contour.axis.position + contour.radius * SideSeenFrom(contour, center),
      contour.axis.tangent};
}

OccludingContour AdjustOccludingContour(
    const OccludingContour& start,
    const std::vector<PlaneMeasurement>& measurements,
    double sigma_px) {
  OccludingContour contour = start;
  std::vector<Eigen::Vector3d> centers;
  for (const PlaneMeasurement& m : measurements) centers.push_back(m.center);
  contour.outward = MeanSide(contour.axis, centers);
  if (contour.outward.dot(start.outward) < 0)
    contour.outward = -contour.outward;
  contour.radius = FitRadius(contour, measurements, sigma_px);
  // A camera sees the contour where one that stands beside it would see the
  // axis.
  std::vector<PlaneMeasurement> of_axis = measurements;
  for (PlaneMeasurement& m : of_axis) {
    m.center -= contour.radius * SideSeenFrom(contour, m.center);
  }
  contour.axis = AdjustEdge(contour.axis, of_axis, sigma_px).edge;
  return contour;
}

}  // namespace curvix
