// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Parts of lines, arcs, ellipses and splines.
#pragma once

#include <curvix/fitting.h>
#include <Eigen/Core>
#include <vector>

namespace curvix {

// From PointAt(fit, t0) to PointAt(fit, t1), t0 < t1, exactly: the same kind of
// primitive, open. Whole circles and ellipses go on behind 1. Ends that are cut
// are at no node.
CurveFit PartOf(const CurveFit& fit, double t0, double t1);

// The parts with low <= axis . x <= high, in their order; `fit` itself if that
// is all of it. Parts of splines shorter than a sixteenth of the space between
// knots may be missed.
std::vector<CurveFit> PartsWithin(const CurveFit& fit,
                                  const Eigen::Vector3d& axis,
                                  double low,
                                  double high);

}  // namespace curvix
