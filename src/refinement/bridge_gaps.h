// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Whole curves.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>

#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Joins open ends that continue each other at their own curvature: a parabola
// in arc length is fitted to the last 15 px before each end, and carried on
// over the gap it must come within 1 px plus a tenth of the gap of the other
// end, at less than 15 degrees from its direction; from both sides. Gaps are at
// most options.max_gap_px, and no longer than what was fitted. The nearest ends
// first; ties by the order of curves. The gap is filled with samples on the
// cubic that fits both ends; they have the sigma and evidence of the weaker end
// and no support. Curves whose own ends meet so become closed. Pixels as in
// pixel_size.h.
std::vector<Curve> BridgeGaps(std::vector<Curve> curves,
                              const std::vector<PosedView>& views,
                              const CurveRefinementOptions& options);

}  // namespace curvix
