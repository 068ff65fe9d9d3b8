// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves that touch each other.
#pragma once

#include <curvix/curves.h>

#include <vector>

#include "model/posed_view.h"
#include "refinement/image_support.h"

namespace curvix {

// What two curves share where they touch has been drawn once: the one ends on
// either side of it, and the other may come in as the one and go on as the
// other. Wherever two ends meet beside a passing curve (find_meetings.h), both
// curves are carried on through what they share, exchanged if need be: the last
// 3 px before the ends are cut off, and gaps are filled (fill_gap.h).
std::vector<Curve> SeparateTouching(std::vector<Curve> curves,
                                    const std::vector<PosedView>& views,
                                    const ImageSupport& images);

}  // namespace curvix
