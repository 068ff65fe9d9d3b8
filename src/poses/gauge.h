// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The gauge: the world frame and unit of the input
// poses.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Where a view with its new pose sees a place of the new world.
struct SeenPlace {
  std::size_t view_idx = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // new world
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// old_world_from_new_world: the rigid transform after which `views`, with their
// old poses, see the places nearest to where the new poses see them. Camera
// centres would determine it poorly: a small rotation and a small translation
// of a camera hardly change its image together. Gauss-Newton with Cauchy's
// weights, of the median distance so far; the identity without places.
Rigid3 FixGauge(const std::vector<PosedView>& views,
                const std::vector<SeenPlace>& places);

}  // namespace curvix
