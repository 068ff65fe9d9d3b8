// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5, Fig. 7. Aligns parallel tracks of edges.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/edge_geometry.h"
#include "model/neighborhood_graph.h"

namespace curvix {

// Moves all edges at once by options.step_size times the pull of their
// neighbours (PullOn), options.num_iterations times:
//   x <- x + step force,   t <- (t + step torque) / |...|.
// Supports do not change. Edges without neighbours do not move. Two groups of
// edges without links between them have no effect on each other.
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

struct ForceModel {
  // d_0 of the weights below: the distance at which they fall to a half. World
  // units, > 0.
  double half_distance = 1;
  // The direction of the line that attracts: the mean of both edges' (true) or
  // the neighbour's (false, the paper).
  // Deviation: tangent lines lie outside a circle, so those of the neighbours
  // pull it outwards for ever. The mean direction of two tangents of a circle
  // is that of their chord: no force, at any radius.
  bool use_mean_direction = true;
};

// The mean force and torque on an edge.
struct Pull {
  // Towards the lines through the neighbours, world units.
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  // Change of the tangent towards the neighbours' directions, normal to the
  // tangent.
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
};

// Neighbour j at offset d from the edge pulls with
//   force  d - (d.u)u, u the direction of the attracting line: the way to that
//          line across it, nothing along it;
//   torque +-t_j - t, the sign that brings t_j to the side of t;
//   weight (link weight) / (|d| + d_0): falls with the distance as in the
//          paper, but stays finite where edges coincide.
// The means are over the weights. No neighbours: zero.
Pull PullOn(std::size_t edge_idx,
            std::span<const NeighborLink> neighbors,
            const std::vector<SpaceEdge>& points,
            const ForceModel& model);

}  // namespace curvix
