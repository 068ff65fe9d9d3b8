// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Images of a solid, with exact pixel areas.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <vector>

#include "synthetic/solid.h"
#include "synthetic/surfaces.h"

namespace curvix {

// Grey levels before noise and rounding, row-major.
struct RenderedImage {
  int width = 0;
  int height = 0;
  std::vector<float> grey;

  // Between pixel centres, bilinear; at the border the nearest pixels.
  double At(const Eigen::Vector2d& pixel) const;
};

// The mean of the scene's brightness over each square pixel (a box filter; no
// blur besides). Where faces meet inside a pixel, the shares of both are
// measured to about 1/100 of its area; a camera with distortion bends the
// image itself, not a resampled one. Directions that the camera model cannot
// invert show the background.
RenderedImage Render(const Solid& solid,
                     const Surfaces& surfaces,
                     const Camera& camera,
                     const Rigid3& cam_from_world);

}  // namespace curvix
