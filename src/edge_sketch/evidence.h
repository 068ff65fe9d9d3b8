// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Weighs which views support a 3D edge and which do
// not.
//
// What a view shows where a 3D edge projects has a likelihood under "a real
// edge, seen here" and one under "nothing, and other edges lie about by
// chance". The logarithm of their ratio is the view's vote:
//   log(q N(r) N(a) / c + 1 - q)  with an edge at distance r and angle a,
//   log(1 - q)                    without;
// N are normal densities with wide tails, q = 0.9 the share of seen edges that
// are detected, and c the density of edges of like direction around the place.
//
// A real edge is seen from one or two connected regions of viewing directions,
// so a view without support between supporting views speaks against it, and one
// far from all of them hardly does. Therefore each vote is averaged with those
// of the views next in direction, and the evidence is the sum of the positive
// averages: regions of support count, scattered support cancels.
#pragma once

#include <optional>
#include <vector>

namespace curvix {

// A neighbour of a view in viewing direction, with the weight of its vote.
struct ViewNeighbor {
  int view_idx = 0;
  double weight = 0;  // exp(-(angle / 25 deg)^2 / 2)
};

// How a supporting edge lies relative to the projected 3D edge.
struct SupportFit {
  double distance_px = 0;  // across the edge
  double sigma_px = 0;     // expected standard deviation of the distance, > 0
  double angle_rad = 0;    // between the directions
};

// The vote of a view with a supporting edge; `density` of like edges per pixel
// across them, > 0. Natural logarithm units.
double VoteWithSupport(const SupportFit& fit, double density);

// The vote of a view that ought to show the edge and does not.
double VoteWithoutSupport();

using Votes = std::vector<std::optional<double>>;  // by view; none: not asked

// The sum over regions of support; `votes` and `neighbors` by view index. >= 0.
double Evidence(const Votes& votes,
                const std::vector<std::vector<ViewNeighbor>>& neighbors);

}  // namespace curvix
