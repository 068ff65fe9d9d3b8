// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5 (ii). Neighbours along image contours, and, beyond the paper,
// edges without the scatter along them.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <vector>

namespace curvix {

// For each edge, the nearest edge ahead of it and the nearest behind it along
// its tangent, within max_neighbor_distance_px, such that both tangents and the
// chord between the two edges are within 15 degrees of each other.
// Tangents are compared as directed, so that both edges are bright on the same
// side. Of two equally near edges the one with the smaller index counts. Links
// are mutual unless edges crowd. Time is linear in the number of edges while
// their density is bounded.
std::vector<EdgeNeighbors> LinkNeighbors(const std::vector<Edge2d>& edges,
                                         const EdgeDetectionOptions& options);

// Texture and noise scatter the edges of a contour by some tenths of a pixel
// and some degrees. A parabola is fitted to the contour as far on one side of
// an edge as on the other, at most 16 px. The edge moves onto it, across its
// tangent, and turns to it. If the contour leaves the parabola by more than
// 0.25 px (root mean square) or bends by more than a radian on either side,
// half as much is fitted, and so on. The edge stays if this comes below 2 px or
// five edges. Edges and `neighbors` correspond; links stay as they are.
void SmoothContours(const std::vector<EdgeNeighbors>& neighbors,
                    std::vector<Edge2d>* edges);

}  // namespace curvix
