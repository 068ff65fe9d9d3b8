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
//  1. Gaussian derivatives at half-pixel sampling; gradient magnitude.
//  2. Non-maximum suppression along the gradient with a parabola through three
//     values interpolated between grid neighbours: position.
//  3. Tangent of the curve F = g^T H g = 0 (g gradient, H Hessian) at that
//     position, from derivatives up to the third order: orientation.
std::vector<Edge2d> DetectThirdOrderEdges(const GrayImage& image,
                                          const EdgeDetectionOptions& options);

}  // namespace curvix
