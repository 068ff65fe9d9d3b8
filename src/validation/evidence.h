// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Weighs which views support a 3D edge and which do
// not.
//
// A real edge is seen from one or two connected regions of viewing directions,
// so a view without support between supporting views speaks against it, and one
// far from all of them hardly does. Each view has a log likelihood ratio of
// real and seen over chance: log(q / p0) with support and log((1 - q) / (1 -
// p0)) without, where p0 is the chance of support (EdgeDensity) and q = 0.9. It
// is averaged over the view and its neighbours in direction, and the evidence
// is the sum of the positive averages: regions of support count, scattered
// support cancels.
#pragma once

#include <vector>

namespace curvix {

// A neighbour of a view in viewing direction, with the weight of its vote.
struct ViewNeighbor {
  int view_idx = 0;
  double weight = 0;  // exp(-(angle / 25 deg)^2 / 2)
};

// What a view says about one 3D edge.
struct ViewVote {
  bool asked = false;      // the edge projects into the image
  bool supported = false;  // and there is an edge
  double chance = 0;       // p0
};

// `votes` and `neighbors` by view index. Natural logarithm units; >= 0.
double Evidence(const std::vector<ViewVote>& votes,
                const std::vector<std::vector<ViewNeighbor>>& neighbors);

}  // namespace curvix
