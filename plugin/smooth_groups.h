// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#pragma once

#include <curvix/synthetic.h>

#include <vector>

namespace curvix {

// For each sample the smallest id of the chain of true curves that continue
// each other smoothly: an end of one within `max_gap` (world units) of an end
// of the other, directions within 15 degrees. Each end continues at most one
// other, the straightest first. A circle that the truth draws as two arcs is
// one curve to whoever sees it.
std::vector<int> SmoothGroups(const std::vector<TrueSample>& truth,
                              double max_gap);

}  // namespace curvix
