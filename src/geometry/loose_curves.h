// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves too short to say something.
#pragma once

#include <curvix/curves.h>

#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Without the curves that have fewer than two samples or are shorter than
// `min_length_px` (pixel_size.h), unless they lead from one junction, that is a
// place of ends equal to the last bit, to another.
std::vector<Curve> DropLooseShortCurves(std::vector<Curve> curves,
                                        const std::vector<PosedView>& views,
                                        double min_length_px);

}  // namespace curvix
