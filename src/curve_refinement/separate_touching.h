// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves that touch each other.
#pragma once

#include <curvix/curves.h>
#include <vector>

#include "curve_refinement/image_support.h"
#include "model/posed_view.h"

namespace curvix {

// Where two curves touch, the shared segment is traced once: one curve breaks,
// or the two are swapped behind it. Wherever two ends meet beside a passing
// curve, both curves are carried on through what they share, exchanged if need
// be: the last 3 px before the ends are cut off, and gaps are filled
// (fill_gap.h).
std::vector<Curve> SeparateTouching(std::vector<Curve> curves,
                                    const std::vector<PosedView>& views,
                                    const ImageSupport& images,
                                    int num_threads);

}  // namespace curvix
