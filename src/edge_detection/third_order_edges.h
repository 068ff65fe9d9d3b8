// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. Sub-pixel edges with third-order orientation.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>

#include <vector>

#include "edge_detection/gray_image.h"

namespace curvix {

// The edges of `image`, in its own (possibly distorted) pixels, row by row on
// the half-pixel grid. Steps:
//  1. Gaussian derivatives (options.sigma_px) at half-pixel sampling; gradient
//     magnitude; points at or below `min_gradient` (grey levels per pixel) are
//     done with.
//  2. Non-maximum suppression along the gradient with a parabola through three
//     values interpolated between grid neighbours: position. Edges nearer than
//     options.border_px to the border are dropped.
//  3. Tangent of the curve F = g^T H g = 0 (g gradient, H Hessian) at that
//     position, from derivatives up to the third order: orientation. The
//     strength is the gradient's magnitude there.
// Images below 2 x 2 pixels have no edges.
std::vector<Edge2d> DetectThirdOrderEdges(const GrayImage& image,
                                          const EdgeDetectionOptions& options,
                                          double min_gradient);

}  // namespace curvix
