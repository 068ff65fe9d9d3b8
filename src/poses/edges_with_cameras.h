// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Whether edges can be seen through other cameras.
#pragma once

#include <curvix/edges.h>
#include <curvix/scene.h>
#include <curvix/status.h>

#include <vector>

namespace curvix {

// Whether EdgesWithCameras() has a result; else kInvalidArgument and the first
// view that has none. Input as there, and not checked.
Status CanCarryEdges(const Scene& scene,
                     const std::vector<EdgeMap>& edge_maps,
                     const std::vector<Camera>& cameras);

}  // namespace curvix
