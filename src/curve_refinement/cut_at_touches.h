// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Junctions of curves that touch.
#pragma once

#include <curvix/curves.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Cuts two curves where they touch, so that all four pieces end in one place:
// amid the segments of at most 120 px along which either is within 2 px and 10
// degrees of the other, if they come within 1 px there and both go on for 5 px
// or more. Nearest pairs first, ties by the order of curves and samples. The
// pieces take the place of the curve. Pixels as in pixel_size.h.
std::vector<Curve> CutAtTouches(std::vector<Curve> curves,
                                const std::vector<PosedView>& views);

}  // namespace curvix
