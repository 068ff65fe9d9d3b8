// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). From which side a 3D edge is seen.
//
// A surface shows its edges and markings to the views in front of it only. Seen
// along the tangent of an edge, these are the views in half a turn. A view
// behind the surface has no vote on the edge, even if a view next to it
// in direction is in front.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge_sketch/evidence.h"
#include "edge_sketch/view_index.h"
#include "geometry/edge_geometry.h"

namespace curvix {

struct VisibleSide {
  // Log-likelihood ratio, >= 0: Evidence() of the votes of the views in front,
  // plus the logarithm of the prior probability of this side.
  double evidence = 0;
  // Unit vector across the edge, world: the direction in the middle of the half
  // turn. nullopt: the edge is seen from all around.
  std::optional<Eigen::Vector3d> facing;
};

// Whether a view at `center` is in front of an edge that faces `facing`.
bool IsInFront(const Eigen::Vector3d& center,
               const SpaceEdge& edge,
               const std::optional<Eigen::Vector3d>& facing);

// The side with the largest evidence. The prior probability of all around is
// one half. That of a half turn is proportional to the angle by which it can
// turn before the views in front change. Ties: all around, then the larger
// probability. `votes` and `neighbors` by view index.
VisibleSide FindVisibleSide(const SpaceEdge& edge,
                            const Votes& votes,
                            const NeighborsByView& neighbors,
                            const std::vector<ViewIndex>& views);

}  // namespace curvix
