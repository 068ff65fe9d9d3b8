// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. All edges of one view.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/scene.h>
#include <curvix/status.h>

namespace curvix {

// Weakest gradient that counts as an edge where the image noise has standard
// deviation `noise`: max(min_gradient, noise_factor * standard deviation of the
// gradient of the noise). Grey levels per pixel.
double GradientThreshold(const EdgeDetectionOptions& options, double noise);

// The edges of the view's image, linked along its contours and carried to the
// ideal pinhole of `camera`, which is the view's. kInvalidArgument: the image
// is not of the camera's size. Other errors: those of LoadGrayImage().
Result<EdgeMap> DetectViewEdges(const View& view,
                                const Camera& camera,
                                const EdgeDetectionOptions& options);

}  // namespace curvix
