// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 6. The connectivity graph: forward and backward neighbour of each
// edge, and the curves that follow them.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/options.h>
#include <vector>

#include "model/curve_chains.h"
#include "model/neighborhood_graph.h"
#include "model/posed_view.h"

namespace curvix {

// Projects the linked edges onto the line of each edge and connects it to the
// nearest on either side, if both choose each other. Candidates are at most
// 4 pixels away along either line, at most kMaxNormalDistancePx across it and
// no further than along it, and at most options.max_angle_deg off in direction;
// pixels as in pixel_size.h. "Nearest" is the sum of both distances, each the
// larger of the two lines'; ties: the smaller index. Edges that project onto
// the same point are no candidates for each other.
//
// The graph is given as ties between ends; item i is edge i, whose tangent
// points to its head.
//
// Deviation: the paper has no limit across the line and no mutual choice.
// Without them traces jump between parallel tracks and branch.
EndTies ConnectEdges(const std::vector<Edge3d>& edges,
                     const NeighborhoodGraph& graph,
                     const std::vector<PosedView>& views,
                     const ConnectivityOptions& options,
                     int num_threads);

// The chains of FollowEnds as curves, in the same order: samples in walking
// order, tangents along the curve, support carried over. A chain that returns
// to its start is a closed curve. Every edge is in exactly one curve, once; an
// edge without neighbours is a curve of one sample, for JoinCurves to take up
// or GroupEdges to drop.
std::vector<Curve> TraceCurves(const std::vector<Edge3d>& edges,
                               const EndTies& ties);

}  // namespace curvix
