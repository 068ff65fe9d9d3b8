// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Corners that are too blunt to see before the fit.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Cuts curves at corners of more than options.max_corner_deg: samples where a
// line or arc fits before and another behind, much better than one parabola
// fits both, and the two meet at a larger angle than either of them turns by.
// Bends have no such sample. Of samples near each other the one with the best
// fit is cut, ties by their order, and is in both pieces. The pieces are in the
// order of the curves.
std::vector<Curve> CutCorners(const std::vector<Curve>& curves,
                              const std::vector<PosedView>& views,
                              const CurveRefinementOptions& options,
                              int num_threads);

}  // namespace curvix
