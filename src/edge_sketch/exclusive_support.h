// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). A 2D edge shows one place of the scene.
#pragma once

#include <curvix/edges.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Leaves out 3D edges that live on the 2D edges of others: a wrong combination
// of 2D edges is supported, as a rule, by edges that show real curves, and
// those have support in more views. In the order of falling evidence (ties: the
// smaller index), each 3D edge claims its supporting 2D edges, and two more to
// either side along their contours, unless they are claimed already. A support
// is a 3D edge's own if nobody claimed it before, or one that lies at the same
// place: half a pixel and four standard deviations or less across the tangent.
// What has fewer than `min_num_exclusive_views` own supports is left out and
// claims nothing. The others keep all of their support and their order.
std::vector<Edge3d> DropWithoutExclusiveSupport(
    std::vector<Edge3d> edges,
    const std::vector<PosedView>& views,
    const std::vector<EdgeMap>& edge_maps,
    int min_num_exclusive_views);

}  // namespace curvix
