// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5 (ii). Neighbours along image contours.
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

}  // namespace curvix
