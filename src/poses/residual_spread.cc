// SPDX-License-Identifier: BSD-3-Clause
#include "poses/residual_spread.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/infinity.h"

namespace curvix {
namespace {

constexpr int kNumIterations = 30;
constexpr double kLeastSpreadPx = 0.05;
constexpr double kNarrowPx = 0.3;
// Samples follow each other along curves, so chance makes narrow peaks.
constexpr double kLeastNarrowShare = 0.4;

struct Mixture {
  double spread_px = 1;
  double share = 0.5;  // of the half-normal density
  double log_likelihood = 0;
};

// One step of expectation maximisation; the likelihood is that of `before`.
Mixture Improve(const Mixture& before,
                const std::vector<double>& distances_px,
                double gate_px) {
  constexpr double kPeak = 0.7978845608028654;  // sqrt(2 / pi)
  Mixture after;
  double weights = 0, squares = 0;
  for (const double distance : distances_px) {
    const double z = distance / before.spread_px;
    const double own =
        before.share * kPeak / before.spread_px * std::exp(-0.5 * z * z);
    const double chance = (1 - before.share) / gate_px;
    const double weight = own / (own + chance);
    weights += weight;
    squares += weight * distance * distance;
    after.log_likelihood += std::log(own + chance);
  }
  after.spread_px = std::max(
      kLeastSpreadPx,
      std::sqrt(squares /
                std::max(weights, std::numeric_limits<double>::min())));
  after.share =
      std::min(0.99, weights / static_cast<double>(distances_px.size()));
  return after;
}

}  // namespace

double FitSpread(const std::vector<double>& distances_px, double gate_px) {
  Mixture best;
  best.log_likelihood = -kInfinity;
  for (const double start_px : std::array{1.2, 0.4, 0.1}) {
    Mixture mixture{start_px, 0.5, 0};
    for (int i = 0; i < kNumIterations; ++i) {
      mixture = Improve(mixture, distances_px, gate_px);
    }
    if (mixture.spread_px < kNarrowPx && mixture.share < kLeastNarrowShare) {
      continue;
    }
    if (mixture.log_likelihood > best.log_likelihood) best = mixture;
  }
  return best.spread_px;
}

}  // namespace curvix
