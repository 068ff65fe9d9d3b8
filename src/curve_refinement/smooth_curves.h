// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves without the scatter of their samples.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Moves each sample onto a parabola in arc length fitted to the samples around
// it, with weights that fall off as a Gaussian of standard deviation
// options.smoothing_px (0: nothing moves) and with the samples' variance, and
// turns its tangent to the parabola's. Ends are fitted from one side; closed
// curves go round. Curves of fewer than five samples stay as they are.
std::vector<Curve> SmoothCurves(const std::vector<Curve>& curves,
                                const std::vector<PosedView>& views,
                                const CurveRefinementOptions& options,
                                int num_threads);

}  // namespace curvix
