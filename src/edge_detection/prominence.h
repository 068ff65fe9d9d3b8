// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Structure apart from texture.
#pragma once

#include <curvix/edges.h>

#include <vector>

#include "edge_detection/third_order_edges.h"

namespace curvix {

// How much each edge stands out from what surrounds it: its strength, less
// where there are edges as strong on both sides. Grey levels per pixel.
//
// Where a surface or an object ends, one side is empty, or its edges are
// weaker; inside brick, foliage and gravel both sides are crowded. What counts
// is the emptier side: the mean strength of edges per pixel in a square of 9
// pixels whose centre lies 8 pixels from the edge. A fifth of the edge's own
// strength there halves the prominence; a parallel contour as strong has about
// half of that. What lies outside the image is empty. Positions are those of
// the image, strengths positive.
std::vector<double> Prominence(const std::vector<Edge2d>& edges);
std::vector<double> Prominence(const std::vector<LocatedEdge>& edges);

}  // namespace curvix
