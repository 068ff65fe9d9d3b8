// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What an image shows, found by other means than
// the edges that curves are made of: curves must not be compared with their own
// detector.
#pragma once

#include <curvix/edges.h>

#include <vector>

#include "edge_detection/gray_image.h"

namespace curvix {

// The pixels of contours: Canny's edges with the strongest tenth of all
// gradients, but at least 4 grey levels per pixel, as upper threshold and half
// of it as the lower one, in connected pieces of 30 pixels or more. Positions
// are centres of pixels, angles those of the contour, strengths the gradient in
// grey levels per pixel; row by row.
std::vector<Edge2d> FindContours(const GrayImage& image);

// Long straight lines (LSD), 2 % of the image's diagonal and longer, as places
// one pixel apart with the angle of their line.
std::vector<Edge2d> FindLongLines(const GrayImage& image);

}  // namespace curvix
