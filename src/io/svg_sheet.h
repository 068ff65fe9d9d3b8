// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). A drawing to scale for browsers and printers.
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

}  // namespace curvix
