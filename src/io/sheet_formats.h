// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Drawings to scale, for browsers, printers and CAD.
#pragma once

#include <string>
#include <string_view>

#include "drawing/sheet.h"

namespace curvix {

// SVG of the size of the paper, in millimetres: a path per primitive (class
// "line", "arc", "circle", "ellipse" or "spline"), arcs as arcs and splines as
// exact Bezier curves, in one group and layer of Inkscape per kind of curve
// (drawing_layers.h), which sets the width of lines; frame and texts in
// another, and the picture, pale, beneath.
std::string EncodeSvgSheet(const Sheet& sheet);

// Whether EncodeSvgSheet wrote it, and no other program since.
bool IsSvgSheet(std::string_view text);

// DXF as EncodeDxfDrawing (curve_formats.h), in drawing units, which are
// declared. Frame, scale bar and texts are on the layer FRAME, the picture, an
// IMAGE that refers to its file, on PHOTOGRAPH; DIMENSION entities, whose texts
// are given, on DIMENSIONS.
std::string EncodeDxfSheet(const Sheet& sheet);

}  // namespace curvix
