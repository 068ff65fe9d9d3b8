// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Refuses input that the stages do not expect.
#pragma once

#include <curvix/edges.h>
#include <curvix/scene.h>
#include <curvix/status.h>
#include <vector>

namespace curvix {

// kInvalidArgument: fewer than three views, a view without camera, a camera
// that is none, a pose or a point that is not finite, a point of views that are
// not there or with a number of pixels that is neither zero nor that of views.
Status CheckScene(const Scene& scene);

// kInvalidArgument: not one map per view, not one entry of neighbours per edge,
// neighbours that are not there, positions or angles that are not finite,
// positions beyond a million pixels.
Status CheckEdgeMaps(const Scene& scene, const std::vector<EdgeMap>& edge_maps);

// kInvalidArgument: a 3D edge that is not finite or whose support is not in the
// edge maps, or not at most one edge per view in ascending order.
Status CheckEdgeSketch(const std::vector<EdgeMap>& edge_maps,
                       const EdgeSketch& sketch);

}  // namespace curvix
