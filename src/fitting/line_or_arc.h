// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Lines and arcs, and how well they are known.
#pragma once

#include <curvix/fitting.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "base/angles.h"

namespace curvix {

// Within these a fit may be said to agree with others: a share of its size, and
// an angle, kKnownDeg of known_directions.h.
constexpr double kNear = 0.01;
constexpr double kNearAngle = DegToRad(1.5);

struct LineOrArc {
  FitIndex index;
  const CurveFit* fit = nullptr;
  // Of a line, or the normal of an arc; unit.
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  Eigen::Matrix3d along_covariance = Eigen::Matrix3d::Zero();
  // The middle of a line, or the centre of an arc.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Matrix3d point_covariance = Eigen::Matrix3d::Zero();
  double size = 0;  // length or radius

  bool is_arc() const { return fit->kind == FitKind::kArc; }
  double along_sigma() const { return std::sqrt(along_covariance.trace() / 2); }
};

// Those of the fits that are longer than nothing; ascending.
std::vector<LineOrArc> LinesAndArcs(const FittedCurves& fitted);

}  // namespace curvix
