// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Primitives as a drawing shows them.
#pragma once

#include <curvix/fitting.h>
#include <optional>

#include "drawing/drawing_plane.h"

namespace curvix {

// `fit` seen along the plane's normal, on the paper (z = 0): lines are lines;
// arcs and ellipses are arcs and ellipses, counter-clockwise, or lines if seen
// from the side; splines are splines. What cannot be told apart within
// fit.sigma is the simpler: an ellipse whose axes differ by less is an arc, of
// the radius of the longer one, which is that of a circle seen at a slant; one
// that is narrower is a line. Ends in one node stay equal to the last bit.
// nullopt: a line seen end on, no longer than fit.sigma.
std::optional<CurveFit> FlatFit(const CurveFit& fit, const DrawingPlane& plane);

}  // namespace curvix
