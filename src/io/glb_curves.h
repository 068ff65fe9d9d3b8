// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Curves for programs that show glTF.
#pragma once

#include <curvix/curves.h>
#include <curvix/status.h>

#include "base/file_io.h"

namespace curvix {

// Binary glTF 2.0: a mesh of one primitive per curve, a line strip, or a line
// loop if it is closed, with positions and colours, unlit; node "curves", and
// the id of a curve in the primitive's extras. Positions are 32-bit floats
// relative to the node's translation, the middle of the curves, so that far
// origins lose no digits. kUnsupported beyond 4 GB.
Status EncodeGlbCurves(const CurveSource& curves, const ByteSink& sink);

}  // namespace curvix
