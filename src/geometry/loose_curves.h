// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves too short to say something.
#pragma once

#include <curvix/curves.h>

#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Whether it has fewer than two samples or is shorter than `min_length_px`
// (pixel_size.h).
bool IsShort(const Curve& curve,
             const std::vector<PosedView>& views,
             double min_length_px);

// Whether it leads from one junction to another; they are indexed.
bool LeadsSomewhere(const Curve& curve);

// Without the short curves, unless they lead from one junction, that is a place
// of ends equal to the last bit, to another.
std::vector<Curve> DropLooseShortCurves(std::vector<Curve> curves,
                                        const std::vector<PosedView>& views,
                                        double min_length_px);

}  // namespace curvix
