// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What of a part's curves is near its core.
#pragma once

#include <curvix/curves.h>

#include <vector>

#include "parts/regions.h"

namespace curvix {

// The runs of two samples or more that are at most `overlap` beyond the core,
// in the order of the curves; whole curves stay as they are, others lose their
// junctions.
std::vector<Curve> CutCurves(const std::vector<Curve>& curves,
                             const std::vector<Border>& core,
                             double overlap);

}  // namespace curvix
