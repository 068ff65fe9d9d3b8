// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Fits that hold the structure found among them.
#pragma once

#include <curvix/fitting.h>

namespace curvix {

// Moves nodes, free ends of lines, and arcs, as little as their covariances
// allow (least squares), so that the structure of `fitted` holds: groups share
// what they share, perpendicular directions are at right angles. Lines stay
// between their ends, arcs stay on their nodes. All hold to far below a
// standard deviation.
//
// Nothing moves by more than three standard deviations: fits that would, or end
// where a node would, leave their groups, and all is solved again. Groups that
// are left with one fit are dropped, but for directions that are perpendicular
// to others. Covariances, and those of ellipses and splines, which the caller
// fits to their nodes again, stay.
void Regularize(FittedCurves& fitted);

}  // namespace curvix
