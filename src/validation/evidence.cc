// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "validation/evidence.h"

#include <cmath>

namespace curvix {
namespace {

constexpr double kSeenAndDetected = 0.9;  // q

double LogLikelihoodRatio(const ViewVote& vote) {
  return vote.supported ? std::log(kSeenAndDetected / vote.chance)
                        : std::log((1 - kSeenAndDetected) / (1 - vote.chance));
}

}  // namespace

double Evidence(const std::vector<ViewVote>& votes,
                const std::vector<std::vector<ViewNeighbor>>& neighbors) {
  double evidence = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (!votes[i].asked) continue;
    double sum = LogLikelihoodRatio(votes[i]);
    double weights = 1;
    for (const ViewNeighbor& neighbor : neighbors[i]) {
      const ViewVote& vote = votes[static_cast<std::size_t>(neighbor.view_idx)];
      if (!vote.asked) continue;
      sum += neighbor.weight * LogLikelihoodRatio(vote);
      weights += neighbor.weight;
    }
    if (sum > 0) evidence += sum / weights;
  }
  return evidence;
}

}  // namespace curvix
