// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves for VTK and ParaView.
#pragma once

#include <curvix/curves.h>

#include "base/file_io.h"

namespace curvix {

// VTK XML PolyData, text: one polyline per curve (a closed one returns to its
// first point), with point arrays tangent, sigma, support and confidence, and
// cell arrays curve_id and length.
void EncodeVtpCurves(const CurveSource& curves, const ByteSink& sink);

}  // namespace curvix
