// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Fitted curves for CAD.
#pragma once

#include <curvix/fitting.h>
#include <string>
#include <string_view>

#include "base/file_io.h"
#include "drawing/sheet.h"

namespace curvix {

// DXF of AutoCAD 2000 (AC1015), text: LINE, ARC, CIRCLE, ELLIPSE and SPLINE
// entities in model space, in the order of the curves, on one layer per kind of
// curve (drawing_layers.h). Coordinates are those of the model; `unit` is
// declared if DxfHeader knows it.
void EncodeDxfDrawing(const FittedCurves& fitted,
                      std::string_view unit,
                      const ByteSink& sink);

// The same of a sheet, in drawing units, which are declared. Frame, scale bar
// and texts are on the layer FRAME, the picture, an IMAGE that refers to its
// file, on PHOTOGRAPH; DIMENSION entities, whose texts are given, on
// DIMENSIONS.
std::string EncodeDxfSheet(const Sheet& sheet);

}  // namespace curvix
