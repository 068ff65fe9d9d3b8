// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves as a view sees them.
#pragma once

#include <curvix/curves.h>
#include <curvix/scene.h>

#include "base/file_io.h"

namespace curvix {

// SVG in the pixels of the view: one path per curve in its colour, class
// "curve", id "curve_<id>"; empty where the view does not see the curve.
void EncodeSvgCurves(const CurveSource& curves,
                     const View& view,
                     const Camera& camera,
                     const ByteSink& sink);

}  // namespace curvix
