// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering), ahead of Sec. 6. One edge per place.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <vector>

#include "model/neighborhood_graph.h"
#include "model/posed_view.h"

namespace curvix {

struct ThinnedEdges {
  std::vector<Edge3d> edges;
  NeighborhoodGraph graph;  // of `edges`: the links between the groups
};

// Merges every group of linked edges of the same place into one edge: at most
// options.sample_spacing_px from the group's first edge along it,
// kMaxNormalDistancePx across it and options.max_angle_deg off its direction.
//
// First edges are chosen greedily: the edge with most support within these
// limits, its own included, comes first (ties: smaller index), so the central
// one of parallel tracks is preferred. It is moved across its tangent to the
// mean of its group and turned to its mean direction, members weighted by their
// inverse variance, or by their number of supports where that is not known. Its
// sigma is the least and its log-likelihood ratio the greatest of the group,
// since members share most of their 2D edges. Its support is the union, its own
// first, then members in index order; still at most one 2D edge per view. The
// edges come in the order of the first edges' indices.
//
// Deviation: the paper connects all edges. Noise decides the order of several
// edges at almost the same place, and traces zig-zag or skip edges.
// sample_spacing_px = 0 returns the input.
ThinnedEdges ThinEdges(const std::vector<Edge3d>& edges,
                       const NeighborhoodGraph& graph,
                       const std::vector<PosedView>& views,
                       const ConnectivityOptions& options,
                       int num_threads);

}  // namespace curvix
