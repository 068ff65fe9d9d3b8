// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Clamped cubic B-splines with even knots.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "fitting/fit_samples.h"

namespace curvix {

struct Spline {
  std::vector<Eigen::Vector3d> control_points;  // four or more
  std::vector<double> knots;                    // four more, 0 to 1

  Eigen::Vector3d At(double t) const;  // 0 <= t <= 1
};

// The point of a spline at t, from its parts.
Eigen::Vector3d SplineAt(const std::vector<Eigen::Vector3d>& control_points,
                         const std::vector<double>& knots,
                         double t);

// The spline with the least robust sum of squared distances at parameters that
// begin as shares of the samples' length and then slide to the nearest points.
// With `ends`, it starts and ends there exactly. nullopt: fewer samples than
// control points, or no solution.
std::optional<Spline> FitSpline(
    FitSpan samples,
    std::size_t num_control_points,
    const std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& ends);

// Squared distances of the samples from the spline, each near its own place.
std::vector<double> SquaredDistances(const Spline& spline, FitSpan samples);

}  // namespace curvix
