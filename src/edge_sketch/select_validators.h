// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Chooses the query views of a view's hypotheses.
#pragma once

#include <vector>

#include "edge_sketch/view_overlap.h"

namespace curvix {

// More query views cost time and change little.
inline constexpr int kMaxNumValidators = 64;

// All distinct views, if there are at most `max_num` (>= 1) views in all. Else
// h1, its `partners`, and of the views that overlap h1 those that differ most
// in direction, max_num in all: repeatedly the view with the largest ray angle
// to the nearest view chosen so far; ties: the smaller index. Besides, those
// before them at their stations. Ascending.
std::vector<int> SelectValidators(const DistinctViews& views,
                                  int h1,
                                  const std::vector<int>& partners,
                                  int max_num = kMaxNumValidators);

// The overlaps among the views of `chosen` (ascending); none for other views.
Overlaps OverlapsAmong(const Overlaps& overlaps,
                       const std::vector<int>& chosen);

}  // namespace curvix
