// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Fitted curves for CAD.
#pragma once

#include <curvix/fitting.h>

#include "base/file_io.h"

namespace curvix {

// STEP (ISO 10303-21) of AP242: the product "curves", a geometrically bounded
// wireframe. Lines and arcs are TRIMMED_CURVEs of LINE, CIRCLE and ELLIPSE,
// whole ones CIRCLE and ELLIPSE, splines B_SPLINE_CURVE_WITH_KNOTS; each is
// named after its curve, "curve_<id>". There is one GEOMETRIC_CURVE_SET per
// kind, in the order of the curves, on a layer of the name that it has in DXF.
// Coordinates are those of the model. STEP must declare a unit: millimetres.
void EncodeStepDrawing(const FittedCurves& fitted, const ByteSink& sink);

}  // namespace curvix
