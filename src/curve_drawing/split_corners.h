// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering), after Sec. 6. Curves end at corners.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Cuts curves where they turn by more than options.max_corner_deg in one place.
// The turn at a sample is the angle between the mean directions of two
// branches, ahead of it and behind it, less what a curve that bends as evenly
// as the straighter branch would turn in between: a circle of any radius has no
// corners. A corner is the sharpest turn nearby; the cut is where directions
// change most. Ties go to the smaller index. Samples with too short a branch
// are no corners. Pieces come in the order of the curves; a closed curve with
// corners falls into open pieces.
//
// Deviation: an edge detector rounds corners by its own width, and traces
// follow it round those of less than about 70 degrees.
std::vector<Curve> SplitCorners(const std::vector<Curve>& curves,
                                const std::vector<PosedView>& views,
                                const ConnectivityOptions& options);

}  // namespace curvix
