// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/flat_fit.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"

namespace curvix {
namespace {

// Of the longer axis: below it, numbers alone make the difference.
constexpr double kRounding = 1e-9;

// A conic seen from the side: the line between its furthest points along
// `major`.
CurveFit SideView(const CurveFit& conic) {
  CurveFit line = conic;
  line.kind = FitKind::kLine;
  line.closed = false;
  double low = std::cos(conic.start_angle), high = low;
  const auto reach = [&](double cosine) {
    low = std::min(low, cosine);
    high = std::max(high, cosine);
  };
  reach(std::cos(conic.end_angle));
  for (double angle = std::ceil(conic.start_angle / kPi) * kPi;
       angle <= conic.end_angle;
       angle += kPi) {
    reach(std::cos(angle));
  }
  line.start = conic.center + low * conic.major;
  line.end = conic.center + high * conic.major;
  line.start_node = line.end_node = -1;
  return line;
}

// center + cos(t) a + sin(t) b with any a and b, on its own axes.
void TakeAxes(const Eigen::Vector3d& a,
              const Eigen::Vector3d& b,
              CurveFit& conic) {
  // The longer axis is where the distance from the centre is largest.
  const double turn =
      std::atan2(2 * a.dot(b), a.squaredNorm() - b.squaredNorm()) / 2;
  conic.major = std::cos(turn) * a + std::sin(turn) * b;
  conic.minor = std::cos(turn) * b - std::sin(turn) * a;
  conic.start_angle -= turn;
  conic.end_angle -= turn;
  if (conic.major.x() * conic.minor.y() < conic.major.y() * conic.minor.x()) {
    // Clockwise: the other way round.
    conic.minor = -conic.minor;
    const double start = conic.start_angle;
    conic.start_angle = -conic.end_angle;
    conic.end_angle = -start;
    std::swap(conic.start, conic.end);
    std::swap(conic.start_node, conic.end_node);
    std::swap(conic.start_covariance, conic.end_covariance);
  }
  const double start = WrapDirected(conic.start_angle);
  conic.end_angle += start - conic.start_angle;
  conic.start_angle = start;
}

std::optional<CurveFit> FlatConic(const CurveFit& fit,
                                  const DrawingPlane& plane,
                                  CurveFit flat) {
  flat.center = plane.Flat(fit.center);
  const auto along = [&](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(plane.right.dot(v), plane.up.dot(v), 0);
  };
  TakeAxes(along(fit.major), along(fit.minor), flat);
  const double a = flat.major.norm(), b = flat.minor.norm();
  const double tolerance = std::max(fit.sigma, kRounding * fit.major.norm());
  flat.kind = FitKind::kEllipse;
  if (a <= tolerance) return std::nullopt;
  if (b <= tolerance) return SideView(flat);
  if (a - b <= tolerance) {
    flat.kind = FitKind::kArc;
    flat.minor *= a / b;
  }
  return flat;
}

}  // namespace

std::optional<CurveFit> FlatFit(const CurveFit& fit,
                                const DrawingPlane& plane) {
  CurveFit flat = fit;
  flat.start = plane.Flat(fit.start);
  flat.end = plane.Flat(fit.end);
  if (fit.kind == FitKind::kArc || fit.kind == FitKind::kEllipse) {
    return FlatConic(fit, plane, std::move(flat));
  }
  for (Eigen::Vector3d& point : flat.control_points) point = plane.Flat(point);
  if (fit.kind == FitKind::kLine &&
      (flat.end - flat.start).norm() <=
          std::max(fit.sigma, kRounding * (fit.end - fit.start).norm())) {
    return std::nullopt;
  }
  return flat;
}

}  // namespace curvix
