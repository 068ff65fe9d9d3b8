// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
// Directions that fitted curves tell of: lines, axes of arcs, rows of holes.
#pragma once

#include <curvix/fitting.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "geometry/directions.h"

namespace curvix {

// Lines with a smaller angle between them can be parallel.
constexpr double kParallelDeg = 1;

struct KnownDirection {
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();  // unit, of either sign
  double length = 0;    // of the line or arc, world units, > 0
  double variance = 0;  // across, radians^2: the mean of both ways
};

// The variance of the direction of a line; see KnownDirection::variance.
double DirectionVariance(const CurveFit& line);

// Standard deviation of a distance between points with these covariances.
double DistanceSigma(const Eigen::Vector3d& between,
                     const Eigen::Matrix3d& a,
                     const Eigen::Matrix3d& b);

// Of lines, of the axes of arcs, and from each circle to the nearest one of its
// size in its plane; longest first, ties as in `fitted`. Arcs without an
// arc_covariance are left out.
struct DirectionsOfCurves {
  std::vector<KnownDirection> known;  // to kKnownDeg
  std::size_t num_unknown = 0;        // the others
};
DirectionsOfCurves DirectionsOf(const FittedCurves& fitted);

}  // namespace curvix
