// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 6. Forward and backward neighbour of each edge, and the curves
// that follow them.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/options.h>
#include <vector>

#include "model/connectivity_graph.h"
#include "model/neighborhood_graph.h"
#include "model/posed_view.h"

namespace curvix {

// Projects the linked edges onto the line of each edge and connects it to the
// nearest on either side, if both choose each other. Candidates are at most
// options.max_step_px away along either line, at most max_normal_distance_px
// across it and no further than along it, and at most max_angle_deg off in
// direction; pixels as in pixel_size.h. "Nearest" is the sum of both distances,
// each the larger of the two lines'; ties: the smaller index. Edges that
// project onto the same point are no candidates for each other.
//
// Directions follow: the edge with the smallest index of each chain keeps its
// own, the others are flipped where they oppose it.
//
// Deviation: the paper has no limit across the line and no mutual choice.
// Without them traces jump between parallel tracks and branch.
ConnectivityGraph ConnectEdges(const std::vector<Edge3d>& edges,
                               const NeighborhoodGraph& graph,
                               const std::vector<PosedView>& views,
                               const ConnectivityOptions& options,
                               int num_threads);

// Walks from the smallest untraced edge forwards to the end, then backwards,
// until every edge has been visited. Returns the walks in the order of their
// smallest edges; samples in walking order, tangents along the curve, support
// carried over. A walk that returns to its start is a closed curve. Every edge
// is in exactly one curve, once; an edge without neighbours is a curve of one
// sample, for JoinCurves to take up or GroupEdges to drop.
std::vector<Curve> TraceCurves(const std::vector<Edge3d>& edges,
                               const ConnectivityGraph& graph);

}  // namespace curvix
