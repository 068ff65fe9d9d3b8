// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Circles and ellipses in space.
#include "fitting/conic.h"

#include <algorithm>
#include <cmath>

namespace curvix {

Eigen::Vector3d Conic::At(double t) const {
  return center + frame * Eigen::Vector3d(a * std::cos(t), b * std::sin(t), 0);
}

Eigen::Vector3d Conic::Tangent(double t) const {
  return frame *
         Eigen::Vector3d(-a * std::sin(t), b * std::cos(t), 0).normalized();
}

double NearestParameter(const Conic& conic, const Eigen::Vector3d& point) {
  const Eigen::Vector3d local = conic.Local(point);
  if (conic.a == conic.b) return std::atan2(local.y(), local.x());
  constexpr int kNumSteps = 6;
  const Eigen::Array2d axes(conic.a, conic.b);
  const Eigen::Array2d p = local.head<2>().array().abs();
  // (cos t, sin t) in the first quadrant. The point is seen from the centre of
  // curvature e at t; the ellipse is met where the circle about e would be.
  Eigen::Array2d unit = Eigen::Array2d::Constant(std::sqrt(0.5));
  for (int step = 0; step < kNumSteps; ++step) {
    const double difference = conic.a * conic.a - conic.b * conic.b;
    const Eigen::Array2d e(difference * std::pow(unit.x(), 3) / conic.a,
                           -difference * std::pow(unit.y(), 3) / conic.b);
    const double radius = (axes * unit - e).matrix().norm();
    const double distance = (p - e).matrix().norm();
    if (!(distance > 0)) break;
    unit = ((p - e) * (radius / distance) + e) / axes;
    unit = unit.max(0.0).min(1.0);
    unit /= std::max(unit.matrix().norm(), 1e-300);
  }
  return std::atan2(std::copysign(unit.y(), local.y()),
                    std::copysign(unit.x(), local.x()));
}

}  // namespace curvix
