// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The 2D edges behind curves, between the views of a
// part and those of its scene.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/parts.h>

#include <vector>

namespace curvix {

// The edges that support `curves`, in the order of `edge_maps`, and without
// neighbours; the curves name them from now on.
std::vector<EdgeMap> KeepSupport(const std::vector<EdgeMap>& edge_maps,
                                 std::vector<Curve>& curves);

// Adds the edges that support the curves of `part`, whose views are `view_idxs`
// of the scene, to those of the scene; the curves name the scene's views and
// edges from now on.
void MoveSupport(PartResult& part,
                 const std::vector<int>& view_idxs,
                 std::vector<EdgeMap>& scene_edge_maps);

}  // namespace curvix
