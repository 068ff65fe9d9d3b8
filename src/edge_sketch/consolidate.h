// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 4, Fig. 5. H2 edges move onto the epipolar line, and those of one
// hypothesis become one virtual edge.
#pragma once

#include <curvix/options.h>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/edge_geometry.h"
#include "geometry/epipolar.h"

namespace curvix {

// Fig. 5(b): `edge` moved onto `line`, by the first of these that is possible:
//  1. a slide along its tangent t, p' = p - t (n.p + c) / (n.t), of at most
//     max_tangent_shift_px;
//  2. the same after a turn towards the normal of the line by max_turn_deg,
//     which shortens the slide; the turned tangent is kept;
//  3. for an edge within location_tolerance_px of the line, a shift along the
//     line's normal; the tangent is kept.
// nullopt if none is possible. The signs of the tangent and of the line's
// normal make no difference.
std::optional<ImageEdge> SlideToLine(const ImageEdge& edge,
                                     const Line2& line,
                                     double location_tolerance_px,
                                     const ConsolidationOptions& options);

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

// Fig. 5(c): agglomerates edges that lie on `line`: the two clusters with the
// nearest centroids merge first (ties: those first along the line, there the
// smaller edge index), as long as they are at most max_cluster_distance_px
// apart and their mean directions differ by at most max_cluster_angle_deg; a
// pair that differs more is passed over. Directions are averaged mod 180
// degrees. The order of the input makes no difference. O(n log n) plus O(n k)
// per merge, k the clusters within max_cluster_distance_px of one.
VirtualEdges ClusterEdges(const std::vector<LineEdge>& edges,
                          const Line2& line,
                          const ConsolidationOptions& options);

}  // namespace curvix
