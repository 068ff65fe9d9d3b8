// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Samples of curves and how well they are known.
#pragma once

#include <curvix/curves.h>
#include <vector>

#include "fitting/primitive.h"
#include "model/posed_view.h"

namespace curvix {

// What the primitives of a curve of two samples or more are fitted to, with the
// standard deviations that FitCurves describes.
FitSamples MakeSamples(const Curve& curve, const std::vector<PosedView>& views);

}  // namespace curvix
