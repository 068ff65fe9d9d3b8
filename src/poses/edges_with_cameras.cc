// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "poses/edges_with_cameras.h"

#include <curvix/refine_poses.h>

#include <cstddef>
#include <utility>

#include "edge_detection/undistort_edges.h"
#include "model/check_input.h"

namespace curvix {
namespace {

Status CannotBeInverted(const View& view) {
  return {StatusCode::kInvalidArgument,
          "the camera of " + view.name + " cannot be inverted at an edge"};
}

}  // namespace

Status CanCarryEdges(const Scene& scene,
                     const std::vector<EdgeMap>& edge_maps,
                     const std::vector<Camera>& cameras) {
  for (std::size_t i = 0; i < edge_maps.size(); ++i) {
    const auto k = static_cast<std::size_t>(scene.views[i].camera_idx);
    if (cameras[k] != scene.cameras[k] &&
        !CarryEdges(edge_maps[i], scene.cameras[k], cameras[k])) {
      return CannotBeInverted(scene.views[i]);
    }
  }
  return {};
}

Result<std::vector<EdgeMap>> EdgesWithCameras(
    const Scene& scene,
    std::vector<EdgeMap> edge_maps,
    const std::vector<Camera>& cameras) {
  if (Status status = CheckEdgeMaps(scene, edge_maps); !status.ok()) {
    return status;
  }
  for (std::size_t i = 0; i < edge_maps.size(); ++i) {
    const auto k = static_cast<std::size_t>(scene.views[i].camera_idx);
    if (cameras[k] == scene.cameras[k]) continue;
    auto edges = CarryEdges(edge_maps[i], scene.cameras[k], cameras[k]);
    if (!edges) return CannotBeInverted(scene.views[i]);
    edge_maps[i] = *std::move(edges);
  }
  return edge_maps;
}

}  // namespace curvix
