// SPDX-License-Identifier: BSD-3-Clause
#include "poses/find_shift.h"

#include <algorithm>
#include <cmath>

namespace curvix {
namespace {

constexpr double kWidthPx = 0.4;  // of a vote
constexpr double kStepPx = 0.5;
constexpr double kFineStepPx = 0.125;
// A shift has to win this many times the votes of none, and more than chance
// gives the best of some hundred shifts: four standard deviations.
constexpr double kClearly = 1.15;
constexpr double kChanceDeviations = 4;

double NumVotes(const std::vector<EdgesAround>& samples,
                const Eigen::Vector2d& shift) {
  double votes = 0;
  for (const EdgesAround& sample : samples) {
    const double along = sample.normal.dot(shift);
    double least = 4 * kWidthPx;
    for (const double distance : sample.distances_px) {
      least = std::min(least, std::abs(along - distance));
    }
    const double z = least / kWidthPx;
    votes += std::exp(-0.5 * z * z);
  }
  return votes;
}

struct Best {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  double votes = 0;
};

// The best of a square grid around best.shift, or best itself.
Best Search(const std::vector<EdgesAround>& samples,
            double reach_px,
            double step_px,
            Best best) {
  const Eigen::Vector2d center = best.shift;
  const int num_steps = static_cast<int>(std::floor(reach_px / step_px));
  for (int i = -num_steps; i <= num_steps; ++i) {
    for (int k = -num_steps; k <= num_steps; ++k) {
      const Eigen::Vector2d shift = center + step_px * Eigen::Vector2d(k, i);
      const double votes = NumVotes(samples, shift);
      if (votes > best.votes) best = {shift, votes};
    }
  }
  return best;
}

}  // namespace

Eigen::Vector2d FindShift(const std::vector<EdgesAround>& samples,
                          double reach_px) {
  const double votes_of_none = NumVotes(samples, Eigen::Vector2d::Zero());
  const double asked = kClearly * votes_of_none +
                       kChanceDeviations * std::sqrt(votes_of_none + 1);
  // Most samples fit as they are: no shift can win so many votes.
  if (static_cast<double>(samples.size()) <= asked) return {0, 0};
  Best best = Search(samples, reach_px, kStepPx, {});
  best = Search(samples, kStepPx, kFineStepPx, best);
  return best.votes > asked ? best.shift : Eigen::Vector2d(0, 0);
}

}  // namespace curvix
