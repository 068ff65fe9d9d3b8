// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The gauge: the world frame and unit of the input
// poses.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "geometry/similarity.h"
#include "model/posed_view.h"

namespace curvix {

// The pixel at which a view with its new pose sees a place of the new world.
struct SeenPlace {
  std::size_t view_idx = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // new world
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// old_world_from_new_world: the similarity after which `views`, with their old
// poses, project the places nearest to their pixels by the new poses. Camera
// centres would determine it poorly: they depend on the focal length, and
// rotations and translations of a camera can compensate each other in its
// image. Gauss-Newton with Cauchy's weights, scaled by the median distance; the
// identity without places.
Similarity3 FixGauge(const std::vector<PosedView>& views,
                     const std::vector<SeenPlace>& places);

}  // namespace curvix
