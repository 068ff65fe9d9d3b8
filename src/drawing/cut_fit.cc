// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/cut_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/angles.h"

namespace curvix {
namespace {

constexpr std::size_t kDegree = 3;

// The polar form of the polynomial piece of a spline that begins at knot
// `span`: equal arguments give the point, three successive knots a control
// point.
Eigen::Vector3d Blossom(const CurveFit& spline,
                        std::size_t span,
                        const std::array<double, kDegree>& arguments) {
  std::array<Eigen::Vector3d, kDegree + 1> points;
  for (std::size_t i = 0; i <= kDegree; ++i) {
    points[i] = spline.control_points[span - kDegree + i];
  }
  for (std::size_t step = 0; step < kDegree; ++step) {
    for (std::size_t i = kDegree; i > step; --i) {
      const double left = spline.knots[span - kDegree + i];
      const double right = spline.knots[span + i - step];
      const double share = (arguments[step] - left) / (right - left);
      points[i] = (1 - share) * points[i - 1] + share * points[i];
    }
  }
  return points[kDegree];
}

// The piece that holds t, or ends there if t is the last knot.
std::size_t SpanOf(const CurveFit& spline, double t) {
  const std::vector<double>& knots = spline.knots;
  const auto next = std::upper_bound(
      knots.begin() + kDegree + 1, knots.end() - kDegree - 1, t);
  return static_cast<std::size_t>(next - knots.begin()) - 1;
}

CurveFit PartOfSpline(const CurveFit& fit, double t0, double t1) {
  CurveFit part = fit;
  part.knots.assign(kDegree + 1, t0);
  for (const double knot : fit.knots) {
    if (knot > t0 && knot < t1) part.knots.push_back(knot);
  }
  part.knots.insert(part.knots.end(), kDegree + 1, t1);
  part.control_points.clear();
  for (std::size_t i = 0; i + kDegree + 1 < part.knots.size(); ++i) {
    // Pieces agree at the knots between them, so any piece that the control
    // point belongs to will do: that of the middle of its widest space.
    double widest = -1, middle = 0;
    for (std::size_t j = i; j <= i + kDegree; ++j) {
      const double space = part.knots[j + 1] - part.knots[j];
      if (space > widest) middle = (part.knots[j] + part.knots[j + 1]) / 2;
      widest = std::max(widest, space);
    }
    part.control_points.push_back(
        Blossom(fit,
                SpanOf(fit, middle),
                {part.knots[i + 1], part.knots[i + 2], part.knots[i + 3]}));
  }
  for (double& knot : part.knots) knot = (knot - t0) / (t1 - t0);
  return part;
}

// Where axis . x is `value`, in (0, 1).
std::vector<double> CrossingsOfConic(const CurveFit& fit,
                                     const Eigen::Vector3d& axis,
                                     double value) {
  const double a = axis.dot(fit.major), b = axis.dot(fit.minor);
  const double height = (value - axis.dot(fit.center)) / std::hypot(a, b);
  if (!(std::abs(height) < 1)) return {};
  std::vector<double> crossings;
  const double sweep = fit.end_angle - fit.start_angle;
  for (const double side : {-1.0, 1.0}) {
    double angle = std::atan2(b, a) + side * std::acos(height);
    while (angle > fit.start_angle) angle -= 2 * kPi;
    while (angle <= fit.start_angle) angle += 2 * kPi;
    for (; angle < fit.end_angle; angle += 2 * kPi) {
      crossings.push_back((angle - fit.start_angle) / sweep);
    }
  }
  return crossings;
}

std::vector<double> CrossingsOfSpline(const CurveFit& fit,
                                      const Eigen::Vector3d& axis,
                                      double value) {
  constexpr int kSteps = 16;
  constexpr int kNumHalvings = 52;
  const auto height = [&](double t) {
    return axis.dot(PointAt(fit, t)) - value;
  };
  std::vector<double> crossings;
  for (std::size_t k = 0; k + 1 < fit.knots.size(); ++k) {
    const double space = fit.knots[k + 1] - fit.knots[k];
    for (int step = 0; space > 0 && step < kSteps; ++step) {
      double low = fit.knots[k] + space * step / kSteps;
      double high = fit.knots[k] + space * (step + 1) / kSteps;
      const bool is_below = height(low) < 0;
      if (is_below == (height(high) < 0)) continue;
      for (int i = 0; i < kNumHalvings; ++i) {
        const double middle = (low + high) / 2;
        ((height(middle) < 0) == is_below ? low : high) = middle;
      }
      crossings.push_back(low);
    }
  }
  return crossings;
}

std::vector<double> Crossings(const CurveFit& fit,
                              const Eigen::Vector3d& axis,
                              double value) {
  switch (fit.kind) {
    case FitKind::kLine: {
      const double at_start = axis.dot(fit.start), at_end = axis.dot(fit.end);
      const double t = (value - at_start) / (at_end - at_start);
      if (t > 0 && t < 1) return {t};
      return {};
    }
    case FitKind::kArc:
    case FitKind::kEllipse:
      return CrossingsOfConic(fit, axis, value);
    case FitKind::kSpline:
      break;
  }
  return CrossingsOfSpline(fit, axis, value);
}

}  // namespace

CurveFit PartOf(const CurveFit& fit, double t0, double t1) {
  CurveFit part =
      fit.kind == FitKind::kSpline ? PartOfSpline(fit, t0, t1) : fit;
  part.closed = false;
  const double sweep = fit.end_angle - fit.start_angle;
  part.start_angle = fit.start_angle + t0 * sweep;
  part.end_angle = fit.start_angle + t1 * sweep;
  if (part.start_angle > kPi) {
    part.start_angle -= 2 * kPi;
    part.end_angle -= 2 * kPi;
  }
  if (t0 > 0 || fit.closed) {
    part.start_node = -1;
    part.start =
        fit.kind == FitKind::kLine ? PointAt(fit, t0) : PointAt(part, 0);
  }
  if (t1 < 1 || fit.closed) {
    part.end_node = -1;
    part.end = fit.kind == FitKind::kLine ? PointAt(fit, t1) : PointAt(part, 1);
  }
  return part;
}

std::vector<CurveFit> PartsWithin(const CurveFit& fit,
                                  const Eigen::Vector3d& axis,
                                  double low,
                                  double high) {
  std::vector<double> cuts = Crossings(fit, axis, low);
  const std::vector<double> more = Crossings(fit, axis, high);
  cuts.insert(cuts.end(), more.begin(), more.end());
  std::ranges::sort(cuts);
  const bool goes_round =
      fit.closed && fit.kind != FitKind::kSpline && !cuts.empty();
  // A whole circle is cut open at a crossing, anything else at its ends.
  const double first = goes_round ? cuts.front() : 0;
  if (!goes_round) cuts.insert(cuts.begin(), 0);
  cuts.push_back(first + 1);
  std::vector<std::pair<double, double>> kept;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double height = axis.dot(PointAt(fit, (cuts[i] + cuts[i + 1]) / 2));
    if (!(cuts[i] < cuts[i + 1] && height >= low && height <= high)) continue;
    if (!kept.empty() && kept.back().second == cuts[i]) {
      kept.back().second = cuts[i + 1];
    } else {
      kept.emplace_back(cuts[i], cuts[i + 1]);
    }
  }
  std::vector<CurveFit> parts;
  for (const auto& [t0, t1] : kept) {
    if (t1 - t0 == 1) return {fit};
    parts.push_back(PartOf(fit, t0, t1));
  }
  return parts;
}

}  // namespace curvix
