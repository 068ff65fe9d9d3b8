// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 6. From 3D edges to curves, step by step.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/options.h>
#include <vector>

#include "base/cancelled.h"
#include "model/curve_chains.h"
#include "model/neighborhood_graph.h"
#include "model/posed_view.h"

namespace curvix {

// Ordered curves from aligned edges and their neighborhood graph: thinned,
// connected, traced, drawn once, joined, cut at corners, the short ones
// dropped. Between these steps `step_done` is asked; if it says false, the
// result is empty.
std::vector<Curve> GroupEdges(const std::vector<Edge3d>& edges,
                              const NeighborhoodGraph& graph,
                              const std::vector<PosedView>& views,
                              const ConnectivityOptions& options,
                              int num_threads,
                              const StepDone& step_done = {});

// The steps of the above, in their order.

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

// Drops duplicates of longer curves. Curves are taken by decreasing length in
// pixels (ties: smaller index), samples in order. A sample is dropped if one
// that stays, of an earlier curve or earlier on its own, is at most
// options.max_duplicate_distance_px across it, sample_spacing_px along it and
// max_angle_deg off in direction. Curves are split where samples are dropped;
// the parts are in the order of their curves.
//
// Deviation: the paper draws every track. Edges of the same place that no 2D
// edge links, since different views formed them, become parallel curves.
// options.max_duplicate_distance_px = 0 returns the input.
std::vector<Curve> DropDuplicates(std::vector<Curve> curves,
                                  const std::vector<PosedView>& views,
                                  const ConnectivityOptions& options);

// Joins ends of open curves that continue each other: seen from either end, the
// other lies ahead, at most options.max_gap_px away, at most
// kMaxNormalDistancePx off the tangent line of the end, at an angle of at most
// options.max_angle_deg to it, and its own direction differs by no more. The
// nearest ends are joined first, where distance across counts twice; ties: the
// order of curves. A curve whose own ends meet becomes closed. A joined curve
// takes index and direction of the first of its curves.
//
// Deviation: the paper's curves end where an edge has no neighbour; single
// missing edges then break them. options.max_gap_px = 0 returns the input.
std::vector<Curve> JoinCurves(std::vector<Curve> curves,
                              const std::vector<PosedView>& views,
                              const ConnectivityOptions& options);

// Cuts curves where they turn by more than options.max_corner_deg in one place.
// The turn at a sample is the angle between the mean directions of two
// branches, ahead of it and behind it, less what a curve that bends as evenly
// as the straighter branch would turn in between: a circle of any radius has no
// corners. A corner is the sharpest turn nearby; the cut is where directions
// change most. Ties go to the smaller index. Samples with too short a branch
// are no corners. Pieces come in the order of the curves; a closed curve with
// corners falls into open pieces.
//
// Deviation: an edge detector rounds corners by its own width, and traces
// follow it round those of less than about 70 degrees.
std::vector<Curve> SplitCorners(const std::vector<Curve>& curves,
                                const std::vector<PosedView>& views,
                                const ConnectivityOptions& options);

}  // namespace curvix
