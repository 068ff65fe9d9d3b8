// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). A 2D edge shows one place of the scene.
#pragma once

#include <curvix/edges.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Non-maximum suppression of 3D edges by their support. A wrong combination of
// 2D edges is mostly supported by edges of real curves, which have support in
// more views. In the order of ByFallingEvidence(), each 3D edge claims its
// supporting 2D edges, and two more to either side along their contours, unless
// they are claimed already. A support is exclusive if no 3D edge claimed it
// before, or one at the same place: half a pixel and four standard deviations
// or less across the tangent. A 3D edge with fewer than
// `min_num_exclusive_views` exclusive supports is dropped and claims nothing.
// The others keep all of their support and their order.
std::vector<Edge3d> DropWithoutExclusiveSupport(
    std::vector<Edge3d> edges,
    const std::vector<PosedView>& views,
    const std::vector<EdgeMap>& edge_maps,
    int min_num_exclusive_views);

}  // namespace curvix
