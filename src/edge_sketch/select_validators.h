// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Chooses the views that judge a view's hypotheses.
#pragma once

#include <vector>

#include "edge_sketch/view_overlap.h"

namespace curvix {

// More query views cost time and change little.
inline constexpr int kMaxNumValidators = 64;

// All views, if there are at most `max_num` (>= 1). Else view h1 and of those
// that overlap it max_num - 1 in directions as different as can be: one after
// the other that with the largest ray angle to the nearest of those chosen;
// ties: the smaller index. The `partners` of h1 are always among them.
// Ascending. `overlaps` is FindOverlaps() of all views.
std::vector<int> SelectValidators(
    const std::vector<std::vector<ViewOverlap>>& overlaps,
    int h1,
    const std::vector<int>& partners,
    int max_num = kMaxNumValidators);

// The overlaps among the views of `chosen` (ascending); none for other views.
std::vector<std::vector<ViewOverlap>> OverlapsAmong(
    const std::vector<std::vector<ViewOverlap>>& overlaps,
    const std::vector<int>& chosen);

}  // namespace curvix
