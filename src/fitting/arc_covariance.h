// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). How well an arc or circle is known.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fitting/fit_conic.h"

namespace curvix {

// A point that an arc was made to pass through.
struct FixedPoint {
  Eigen::Vector3d position;
  Eigen::Matrix3d covariance;  // world units squared
};

// The covariance, as CurveFit::arc_covariance has it, of a circle that was
// fitted to `samples` by least squares and passes through `points`. Errors of
// the samples: their own, of which one in 4 px is independent and which are
// taken as larger if the samples lie further from the circle; and, of each
// sample's `common`, shapes that all samples share: a constant, a slope and a
// bow, or a constant and a shift if the circle is whole, in the plane and off
// it.
Eigen::Matrix<double, 7, 7> ArcCovariance(const Conic& circle,
                                          const FitSamples& samples,
                                          const std::vector<FixedPoint>& points,
                                          bool is_whole);

}  // namespace curvix
