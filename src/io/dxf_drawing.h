// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Fitted curves for CAD.
#pragma once

#include <curvix/fitting.h>

#include "base/file_io.h"

namespace curvix {

// DXF of AutoCAD 2000 (AC1015), text: LINE, ARC, CIRCLE, ELLIPSE and SPLINE
// entities in model space, in the order of the curves, on one layer per kind
// (LINES, ARCS, CIRCLES, ELLIPSES, SPLINES). Coordinates are those of the
// model; no unit is declared.
void EncodeDxfDrawing(const FittedCurves& fitted, const ByteSink& sink);

}  // namespace curvix
