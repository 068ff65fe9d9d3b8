// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Keeps the world where the input poses show it.
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

// old_world_from_new_world: the rigid motion after which `views`, with their
// old poses, see the places nearest to where the new poses see them. Cameras
// alone would tell it badly: that of a small turn and a small shift has hardly
// an effect on the picture, but moves the camera. Gauss-Newton with Cauchy's
// weights, of the median distance so far; the identity without places.
Rigid3 HoldWorld(const std::vector<PosedView>& views,
                 const std::vector<SeenPlace>& places);

}  // namespace curvix
