// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, which looks along whole epipolar lines. Deviation: sparse
// points bound the depth.
#pragma once

#include <curvix/scene.h>
#include <limits>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Depths along a view's optical axis, world units. The default is all of them.
struct DepthRange {
  double nearest = 0;
  double farthest = std::numeric_limits<double>::infinity();
};

// For each view the depths at which it may see edges, by view_idx: those of the
// sparse points that it sees, without the two nearest and the two farthest,
// which may be wrong, and beyond them `margin` of their range on either side.
// The range counts in inverse depths, as steps along epipolar lines do, and is
// at least a fifth of their median, lest a flat scene has none. All depths for
// a view of fewer than 16 points, and for all views if `margin` is 0.
std::vector<DepthRange> FindDepthRanges(const std::vector<PosedView>& views,
                                        const std::vector<ScenePoint>& points,
                                        double margin);

}  // namespace curvix
