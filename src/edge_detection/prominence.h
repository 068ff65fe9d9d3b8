// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). A measure that is larger for structure than for
// texture.
#pragma once

#include <curvix/edges.h>

#include <vector>

#include "edge_detection/third_order_edges.h"

namespace curvix {

// The strength of each edge, reduced where both sides have edges as strong.
// Grey levels per pixel.
//
// Where a surface or an object ends, one side has no edges, or weaker ones. In
// brick, foliage and gravel both sides are crowded. The emptier side counts,
// with the mean strength of edges per pixel in a square of 9 pixels whose
// centre lies 8 pixels from the edge. A fifth of the edge's own strength there
// halves the prominence; a parallel contour as strong has about half of that.
// What lies outside the image is empty. Positions are those of the image,
// strengths positive.
std::vector<double> Prominence(const std::vector<Edge2d>& edges);
std::vector<double> Prominence(const std::vector<LocatedEdge>& edges);

// Sets the crowding of each edge (Edge2d::crowding), measured as above.
void MeasureCrowding(std::vector<LocatedEdge>* edges);

}  // namespace curvix
