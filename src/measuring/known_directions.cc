// SPDX-License-Identifier: BSD-3-Clause
#include "measuring/known_directions.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/angles.h"

namespace curvix {
namespace {

constexpr double kSigmas = 3;

// Whether both have one radius and lie in one plane.
bool AreAlike(const CurveFit& a, const CurveFit& b) {
  const Eigen::Vector3d axis = NormalOf(a);
  const double tolerance = std::sin(DegToRad(kKnownDeg));
  const Eigen::Vector3d between = b.center - a.center;
  return std::abs(a.major.norm() - b.major.norm()) <
             kSigmas * std::hypot(a.radius_sigma, b.radius_sigma) &&
         axis.cross(NormalOf(b)).norm() < tolerance &&
         std::abs(axis.dot(between)) < tolerance * between.norm();
}

std::vector<KnownDirection> RowsOf(
    const std::vector<const CurveFit*>& circles) {
  std::vector<KnownDirection> rows;
  for (std::size_t i = 0; i < circles.size(); ++i) {
    const CurveFit& a = *circles[i];
    const CurveFit* nearest = nullptr;
    double least = std::numeric_limits<double>::max();
    for (const CurveFit* b : circles) {
      const double distance = (b->center - a.center).norm();
      if (b == &a || !(distance > 0 && distance < least)) continue;
      if (!AreAlike(a, *b)) continue;
      least = distance;
      nearest = b;
    }
    if (nearest == nullptr) continue;
    // A centre is known as well as the radius is.
    const double sigma = std::hypot(a.radius_sigma, nearest->radius_sigma);
    rows.push_back({(nearest->center - a.center) / least,
                    Length(a),
                    sigma * sigma / (least * least)});
  }
  return rows;
}

}  // namespace

double DirectionVariance(const CurveFit& line) {
  const Eigen::Vector3d chord = line.end - line.start;
  const Eigen::Vector3d along = chord.normalized();
  const Eigen::Matrix3d sum = line.start_covariance + line.end_covariance;
  return (sum.trace() - along.dot(sum * along)) / (2 * chord.squaredNorm());
}

double DistanceSigma(const Eigen::Vector3d& between,
                     const Eigen::Matrix3d& a,
                     const Eigen::Matrix3d& b) {
  const double length = between.norm();
  if (!(length > 0)) return std::sqrt((a + b).trace());
  const Eigen::Vector3d along = between / length;
  return std::sqrt(along.dot((a + b) * along));
}

DirectionsOfCurves DirectionsOf(const FittedCurves& fitted) {
  std::vector<KnownDirection> directions;
  std::vector<const CurveFit*> circles;
  for (const FittedCurve& curve : fitted.curves) {
    for (const CurveFit& fit : curve.fits) {
      if (fit.kind == FitKind::kLine) {
        directions.push_back({(fit.end - fit.start).normalized(),
                              Length(fit),
                              DirectionVariance(fit)});
      } else if (fit.kind == FitKind::kArc && !fit.arc_covariance.isZero(0)) {
        const Eigen::Matrix3d axis = fit.arc_covariance.block<3, 3>(3, 3);
        directions.push_back({NormalOf(fit), Length(fit), axis.trace() / 2});
        if (fit.closed) circles.push_back(&fit);
      }
    }
  }
  for (KnownDirection& row : RowsOf(circles)) {
    directions.push_back(std::move(row));
  }
  const double limit = DegToRad(kKnownDeg) * DegToRad(kKnownDeg);
  const auto is_unknown = [&](const KnownDirection& d) {
    return !(d.length > 0 && d.variance < limit);
  };
  const std::size_t num_unknown = std::erase_if(directions, is_unknown);
  std::ranges::stable_sort(
      directions, std::ranges::greater(), &KnownDirection::length);
  return {std::move(directions), num_unknown};
}

}  // namespace curvix
