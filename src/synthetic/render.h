// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Images of a solid, with exact pixel areas.
#pragma once

#include <curvix/scene.h>

#include "base/gray_image.h"
#include "synthetic/solid.h"
#include "synthetic/surfaces.h"

namespace curvix {

// The mean of the scene's brightness over each square pixel (a box filter; no
// blur besides), before noise and rounding. Where faces meet inside a pixel,
// the shares of both are measured to about 1/100 of its area; a camera with
// distortion bends the image itself, not a resampled one. Directions that the
// camera model cannot invert show the background.
GrayImage Render(const Solid& solid,
                 const Surfaces& surfaces,
                 const Camera& camera,
                 const Rigid3& cam_from_world);

}  // namespace curvix
