// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). A measure that is larger for structure than for
// texture.
#pragma once

#include <curvix/edges.h>

#include <vector>

#include "edge_detection/third_order_edges.h"

namespace curvix {

// Sets the crowding of each edge (Edge2d::crowding). Positions are those of the
// image, strengths positive.
//
// Where a surface or an object ends, one side has no edges, or weaker ones. In
// brick, foliage and gravel both sides are crowded. The emptier side counts,
// with the mean strength of edges per pixel in a square of 9 pixels whose
// centre lies 8 pixels from the edge. What lies outside the image is empty.
// `spacing_px`: of edges along their contours; each edge counts as often as it
// has half pixels.
void MeasureCrowding(double spacing_px, std::vector<LocatedEdge>* edges);

// The strength of an edge whose crowding is measured, reduced by it; grey
// levels per pixel. A crowding of a tenth halves it, which is about that
// between two parallel contours as strong.
double Prominence(const LocatedEdge& edge);

// The same of each edge, whose crowding is measured anew, among these edges.
std::vector<double> Prominence(const std::vector<Edge2d>& edges,
                               double spacing_px);

}  // namespace curvix
