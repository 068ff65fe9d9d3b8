// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, which searches whole epipolar lines. Deviation: sparse points
// bound the depth.
#pragma once

#include <curvix/scene.h>
#include <vector>

#include "base/infinity.h"
#include "model/posed_view.h"

namespace curvix {

// Depths along a view's optical axis, world units. The default is all of them.
struct DepthRange {
  double nearest = 0;
  double farthest = kInfinity;
};

// For each view, by view_idx, the depths at which edges are searched: those of
// its sparse points without the two nearest and the two farthest, which may be
// wrong, extended by `margin` of their range on either side. The range is one
// of inverse depths, in which epipolar lines are uniform; it is at least a
// fifth of their median, so that a flat scene has one. All depths for a view of
// fewer than 16 points, and for all views if `margin` is 0.
std::vector<DepthRange> FindDepthRanges(const std::vector<PosedView>& views,
                                        const std::vector<ScenePoint>& points,
                                        double margin);

}  // namespace curvix
