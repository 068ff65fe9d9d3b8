// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Views as the ideal pinholes of their cameras.
#pragma once

#include <curvix/scene.h>

#include <vector>

#include "model/posed_view.h"

namespace curvix {

// `camera` must be valid.
PosedView MakePosedView(const Camera& camera, const Rigid3& cam_from_world);

// One posed view per view of the scene, in order. Cameras must be valid.
std::vector<PosedView> MakePosedViews(const Scene& scene);

}  // namespace curvix
