// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). A line or circle that is known exactly.
#pragma once

#include <curvix/curves.h>

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

namespace curvix {

// A straight or circular edge, by arc length s in [0, length]:
// straight: origin + s * along; circular, of radius r and a = s / r:
// origin + r * (cos(a) * along + sin(a) * across).
struct TrueCurve {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();  // unit
  Eigen::Vector3d across = Eigen::Vector3d::Zero();  // unit; circular only
  double radius = 0;                                 // 0: straight
  double length = 0;                                 // world units
  bool is_closed = false;                            // a whole circle
  CurveKind kind = CurveKind::kCrease;

  Eigen::Vector3d Position(double s) const;
  Eigen::Vector3d Tangent(double s) const;  // unit
};

TrueCurve Segment(const Eigen::Vector3d& from,
                  const Eigen::Vector3d& to,
                  CurveKind kind);

// The whole circle around `centre`, at right angles to the unit `normal`.
TrueCurve Circle(const Eigen::Vector3d& centre,
                 const Eigen::Vector3d& normal,
                 double radius,
                 CurveKind kind);

using OnCurve = std::function<bool(double s)>;

// The intervals of [0, length] in which `holds`, ascending. It is tested at
// steps of `step` or less; their ends are found by bisection.
std::vector<std::pair<double, double>> IntervalsWhere(double length,
                                                      double step,
                                                      const OnCurve& holds);

// Shorter curves are left out: a share of the solid's detail.
inline constexpr double kLeastLength = 1e-2;

// The parts of `whole` where `holds`, of kLeastLength or more. It is tested at
// steps of 1/200 of `detail`, that of the solid, or less. A part of a circle
// through its first point is one curve.
std::vector<TrueCurve> PartsWhere(const TrueCurve& whole,
                                  double detail,
                                  const OnCurve& holds);

}  // namespace curvix
