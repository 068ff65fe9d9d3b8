// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 4, Fig. 5(c). H2 edges of one hypothesis become one virtual edge.
#pragma once

#include <curvix/options.h>
#include <cstddef>
#include <cstdint>
#include <span>
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
  std::size_t first_member = 0;
  std::size_t num_members = 0;
};

// The clusters of one line.
struct VirtualEdges {
  std::vector<VirtualEdge> edges;  // in order along the line
  // The edge indices of one cluster after the other, each in order along the
  // line.
  std::vector<std::int32_t> members;

  std::span<const std::int32_t> MembersOf(const VirtualEdge& edge) const {
    return {members.data() + edge.first_member, edge.num_members};
  }
};

// Agglomerates edges that lie on `line`: the two clusters with the nearest
// centroids merge first (ties: those first along the line, there the smaller
// edge index), as long as they are at most max_cluster_distance_px apart and
// their mean directions differ by at most max_cluster_angle_deg; a pair that
// differs more is passed over. Directions are averaged mod 180 degrees. The
// order of the input makes no difference. O(n log n) plus O(n k) per merge, k
// the clusters within max_cluster_distance_px of one.
VirtualEdges ClusterEdges(const std::vector<LineEdge>& edges,
                          const Line2& line,
                          const ConsolidationOptions& options);

}  // namespace curvix
