// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5, Fig. 7. Parallel tracks of edges made one.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>

#include <vector>

#include "model/neighborhood_graph.h"

namespace curvix {

// Moves all edges at once by options.step_size times the pull of their
// neighbours (forces.h), options.num_iterations times:
//   x <- x + step force,   t <- (t + step torque) / |...|.
// Supports stay. Edges without neighbours stay where they are. Two groups of
// edges without links between them do not feel each other, however close.
//
// Deviation: stops early once no force exceeds 0.001 of the mean length of all
// links; the paper always runs 1000 iterations.
//
// The half distance of the weights is the mean length of all links, so a scene
// of another scale moves in proportion. The result does not depend on the order
// of the edges except for rounding.
// Time: one visit of every link in each iteration, some 10 ns.
std::vector<Edge3d> AlignEdges(const std::vector<Edge3d>& edges,
                               const NeighborhoodGraph& graph,
                               const AlignmentOptions& options,
                               int num_threads);

}  // namespace curvix
