// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What a primitive looks like.
#include <curvix/fitting.h>

#include <cmath>

#include "fitting/spline.h"

namespace curvix {

std::string_view KindName(const CurveFit& fit) {
  switch (fit.kind) {
    case FitKind::kLine:
      return "line";
    case FitKind::kArc:
      return fit.closed ? "circle" : "arc";
    case FitKind::kEllipse:
      return "ellipse";
    case FitKind::kSpline:
      return "spline";
  }
  return "";
}

Eigen::Vector3d PointAt(const CurveFit& fit, double t) {
  switch (fit.kind) {
    case FitKind::kLine:
      return fit.start + t * (fit.end - fit.start);
    case FitKind::kArc:
    case FitKind::kEllipse: {
      const double angle =
          fit.start_angle + t * (fit.end_angle - fit.start_angle);
      return fit.center + std::cos(angle) * fit.major +
             std::sin(angle) * fit.minor;
    }
    case FitKind::kSpline:
      return Spline{fit.control_points, fit.knots}.At(t);
  }
  return fit.start;
}

double Length(const CurveFit& fit) {
  if (fit.kind == FitKind::kLine) return (fit.end - fit.start).norm();
  if (fit.kind == FitKind::kArc) {
    return fit.major.norm() * (fit.end_angle - fit.start_angle);
  }
  constexpr int kNumSteps = 1000;
  double length = 0;
  Eigen::Vector3d last = PointAt(fit, 0);
  for (int i = 1; i <= kNumSteps; ++i) {
    const Eigen::Vector3d next =
        PointAt(fit, static_cast<double>(i) / kNumSteps);
    length += (next - last).norm();
    last = next;
  }
  return length;
}

}  // namespace curvix
