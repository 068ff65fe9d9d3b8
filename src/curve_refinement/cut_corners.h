// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Corners that are too blunt to see before the fit.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Cuts curves at corners of more than options.max_corner_deg: where lines or
// arcs fit the 20 px before a sample and the 20 px behind it, 2.5 px aside, to
// 0.2 px and three times as well as one parabola fits both, and meet at a
// larger angle than either of them turns by; of samples within 12 px the one
// where they fit best, ties by their order. It is in both pieces. Bends have no
// such place. In the order of the curves. Pixels as in pixel_size.h.
std::vector<Curve> CutCorners(const std::vector<Curve>& curves,
                              const std::vector<PosedView>& views,
                              const CurveRefinementOptions& options,
                              int num_threads);

}  // namespace curvix
