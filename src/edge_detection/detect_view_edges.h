// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. All edges of one view.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/scene.h>
#include <curvix/status.h>

#include <cstdint>

namespace curvix {

// Weakest gradient, of an image smoothed by `sigma_px`, that counts as an edge
// where the image noise has standard deviation `noise`: max(min_gradient,
// noise_factor * standard deviation of the gradient of the noise). Grey levels
// per pixel.
double GradientThreshold(const EdgeDetectionOptions& options,
                         double sigma_px,
                         double noise);

// Most edges that are kept of an image of that size: at least 20,000, and of n
// million pixels n^0.8 times options.max_edges_per_megapixel.
std::int64_t MaxEdges(const EdgeDetectionOptions& options,
                      int width,
                      int height);

// The edges of the view's image, linked along its contours and mapped to the
// ideal pinhole of `camera`, which is the view's. Crowded images, which have
// more edges than MaxEdges(), are seen at the coarser scale. Isolated edges,
// and the least prominent contours of crowded images, are dropped and counted:
// see KeepContours(). kInvalidArgument: the image is not of the camera's size.
// Other errors: those of LoadGrayImage().
Result<EdgeMap> DetectViewEdges(const View& view,
                                const Camera& camera,
                                const EdgeDetectionOptions& options);

}  // namespace curvix
