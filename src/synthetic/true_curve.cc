// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/true_curve.h"

#include "base/angles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace curvix {
namespace {

using Eigen::Vector3d;

TrueCurve Part(const TrueCurve& whole, double begin, double end) {
  TrueCurve part = whole;
  part.length = end - begin;
  part.is_closed = false;
  if (whole.radius == 0) {
    part.origin = whole.Position(begin);
  } else {
    part.along = (whole.Position(begin) - whole.origin).normalized();
    part.across = whole.Tangent(begin);
  }
  return part;
}

}  // namespace

Vector3d TrueCurve::Position(double s) const {
  if (radius == 0) return origin + s * along;
  const double angle = s / radius;
  return origin + radius * (std::cos(angle) * along + std::sin(angle) * across);
}

Vector3d TrueCurve::Tangent(double s) const {
  if (radius == 0) return along;
  const double angle = s / radius;
  return std::cos(angle) * across - std::sin(angle) * along;
}

TrueCurve Segment(const Vector3d& from, const Vector3d& to, CurveKind kind) {
  TrueCurve segment;
  segment.origin = from;
  segment.length = (to - from).norm();
  segment.along = (to - from) / segment.length;
  segment.kind = kind;
  return segment;
}

TrueCurve Circle(const Vector3d& centre,
                 const Vector3d& normal,
                 double radius,
                 CurveKind kind) {
  TrueCurve circle;
  circle.origin = centre;
  circle.along = normal.unitOrthogonal();
  circle.across = normal.cross(circle.along);
  circle.radius = radius;
  circle.length = 2 * kPi * radius;
  circle.is_closed = true;
  circle.kind = kind;
  return circle;
}

std::vector<std::pair<double, double>> IntervalsWhere(double length,
                                                      double step,
                                                      const OnCurve& holds) {
  const auto boundary = [&](double in, double out) {
    for (int i = 0; i < 60; ++i) {
      const double middle = (in + out) / 2;
      (holds(middle) ? in : out) = middle;
    }
    return in;
  };
  std::vector<std::pair<double, double>> intervals;
  const int num_steps = std::max(8, static_cast<int>(length / step));
  bool held = holds(0);
  if (held) intervals.push_back({0, length});
  for (int i = 1; i <= num_steps; ++i) {
    const double s = length * i / num_steps;
    const double previous = length * (i - 1) / num_steps;
    const bool holds_here = holds(s);
    if (holds_here && !held) {
      intervals.push_back({boundary(s, previous), length});
    }
    if (!holds_here && held) intervals.back().second = boundary(previous, s);
    held = holds_here;
  }
  return intervals;
}

std::vector<TrueCurve> PartsWhere(const TrueCurve& whole,
                                  double detail,
                                  const OnCurve& holds) {
  auto intervals = IntervalsWhere(whole.length, detail / 200, holds);
  if (intervals.empty()) return {};
  if (whole.is_closed) {
    if (intervals.front() == std::pair(0.0, whole.length)) return {whole};
    if (intervals.front().first == 0 &&
        intervals.back().second == whole.length) {
      intervals.back().second += intervals.front().second;
      intervals.erase(intervals.begin());
    }
  }
  std::vector<TrueCurve> parts;
  for (const auto& [begin, end] : intervals) {
    if (end - begin < kLeastLength * detail) continue;
    parts.push_back(Part(whole, begin, end));
  }
  return parts;
}

}  // namespace curvix
