// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/adjust_edge.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace curvix {
namespace {

constexpr int kNumIterations = 3;

struct NormalEquations {
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Eigen::Vector2d vector = Eigen::Vector2d::Zero();
  double weighted_squares = 0;
  double weights = 0;
};

NormalEquations Linearise(const EdgeEstimate& estimate,
                          std::span<const PlaneMeasurement> measurements,
                          double sigma_px) {
  NormalEquations sum;
  for (const PlaneMeasurement& m : measurements) {
    const SeenDistance distance = DistanceFrom(m, estimate.edge.position);
    const double weight = CauchyWeight(distance.px, sigma_px);
    const Eigen::Vector2d gradient(
        distance.gradient.dot(estimate.across.col(0)),
        distance.gradient.dot(estimate.across.col(1)));
    sum.matrix += weight * gradient * gradient.transpose();
    sum.vector += weight * distance.px * gradient;
    sum.weighted_squares += weight * distance.px * distance.px;
    sum.weights += weight;
  }
  // Keeps the system regular: a prior as weak as a thousandth of a measurement.
  const double prior =
      1e-3 * sum.matrix.trace() / static_cast<double>(measurements.size());
  sum.matrix += prior * Eigen::Matrix2d::Identity();
  return sum;
}

// The direction most orthogonal to the planes' normals and, with a weight, to
// the rays, on the side of the estimate.
Eigen::Vector3d FitTangent(const EdgeEstimate& estimate,
                           const std::vector<PlaneMeasurement>& measurements,
                           double sigma_px,
                           double ray_weight) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const PlaneMeasurement& m : measurements) {
    const Eigen::Vector3d normal = m.plane.normalized();
    const Eigen::Vector3d ray =
        (estimate.edge.position - m.center).normalized();
    const double weight =
        CauchyWeight(DistanceFrom(m, estimate.edge.position).px, sigma_px);
    scatter += weight * normal * normal.transpose();
    scatter += weight * ray_weight * ray * ray.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(scatter);
  const Eigen::Vector3d eigenvalues = solver.eigenvalues();
  // Without rays, planes that all but coincide leave the tangent open.
  if (!(eigenvalues(1) > 1e-4 * eigenvalues(2))) return estimate.edge.tangent;
  const Eigen::Vector3d tangent = solver.eigenvectors().col(0).normalized();
  return tangent.dot(estimate.edge.tangent) < 0 ? -tangent : tangent;
}

}  // namespace

PlaneMeasurement MeasurePlane(const PosedView& view, const ImageEdge& edge) {
  return {EdgePlane(view, edge), view.center, view.rotation.row(2).transpose()};
}

EdgeEstimate AdjustEdge(const SpaceEdge& start,
                        const std::vector<PlaneMeasurement>& measurements,
                        double sigma_px,
                        double ray_weight) {
  EdgeEstimate estimate;
  estimate.edge = start;
  estimate.across = AxesAcross(estimate.edge.tangent);
  for (int i = 0; i < kNumIterations; ++i) {
    const NormalEquations sum = Linearise(estimate, measurements, sigma_px);
    const Eigen::Vector2d step = -(sum.matrix.inverse() * sum.vector);
    estimate.edge.position +=
        step.x() * estimate.across.col(0) + step.y() * estimate.across.col(1);
  }
  estimate.edge.tangent =
      FitTangent(estimate, measurements, sigma_px, ray_weight);
  estimate.across = AxesAcross(estimate.edge.tangent);
  const NormalEquations sum = Linearise(estimate, measurements, sigma_px);
  const double spread2 = sum.weighted_squares / std::max(sum.weights, 1e-12);
  estimate.covariance =
      std::max(sigma_px * sigma_px, spread2) * sum.matrix.inverse();
  return estimate;
}

EdgeEstimate EstimateAtMeeting(const SpaceEdge& edge,
                               const PlaneMeasurement& measurement1,
                               const PlaneMeasurement& measurement2,
                               double sigma_px) {
  EdgeEstimate estimate;
  estimate.edge = edge;
  estimate.across = AxesAcross(estimate.edge.tangent);
  const std::array measurements = {measurement1, measurement2};
  estimate.covariance =
      sigma_px * sigma_px *
      Linearise(estimate, measurements, sigma_px).matrix.inverse();
  return estimate;
}

double VarianceAcross(const PosedView& view,
                      const ImageEdge& projected,
                      const EdgeEstimate& estimate) {
  // The distance's gradient by the position is plane / depth.
  const Eigen::Vector3d plane = EdgePlane(view, projected);
  const double depth =
      view.rotation.row(2).dot(estimate.edge.position - view.center);
  const Eigen::Vector2d gradient(plane.dot(estimate.across.col(0)) / depth,
                                 plane.dot(estimate.across.col(1)) / depth);
  return gradient.dot(estimate.covariance * gradient);
}

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
