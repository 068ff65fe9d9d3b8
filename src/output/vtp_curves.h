// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves for VTK and ParaView.
#pragma once

#include <curvix/curves.h>

#include <string>

namespace curvix {

// VTK XML PolyData, text: one polyline per curve (a closed one returns to its
// first point), with point arrays tangent, sigma, support and confidence, and
// cell arrays curve_id and length.
std::string EncodeVtpCurves(const CurveSet& curves);

}  // namespace curvix
