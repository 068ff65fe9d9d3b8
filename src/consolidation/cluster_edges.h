// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 4, Fig. 5(c). H2 edges of one hypothesis become one virtual edge.
#pragma once

#include <curvix/options.h>

#include <cstdint>
#include <vector>

#include "geometry/edge_geometry.h"
#include "geometry/epipolar.h"

namespace curvix {

// An H2 edge moved onto the epipolar line, and which edge it was.
struct LineEdge {
  ImageEdge edge;
  std::int32_t edge_idx = 0;
};

// A cluster of H2 edges and what stands for it.
struct VirtualEdge {
  ImageEdge edge;  // centroid; mean direction, weighted by distance from it
  std::vector<std::int32_t> members;  // edge indices, in order along the line
};

// Agglomerates edges that lie on `line`: the two clusters with the nearest
// centroids merge first (ties: those first along the line, there the smaller
// edge index), as long as they are at most max_cluster_distance_px apart and
// their mean directions differ by at most max_cluster_angle_deg; a pair that
// differs more is passed over. Directions are averaged mod 180 degrees. The
// result is in order along the line; the order of the input makes no
// difference. O(n log n) plus O(n k) per merge, k the clusters within
// max_cluster_distance_px of one.
std::vector<VirtualEdge> ClusterEdges(const std::vector<LineEdge>& edges,
                                      const Line2& line,
                                      const ConsolidationOptions& options);

}  // namespace curvix
