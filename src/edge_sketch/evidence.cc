// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/angles.h"

namespace curvix {
namespace {

constexpr double kSeenAndDetected = 0.9;  // q
// Standard deviation of third-order orientations.
constexpr double kAngleSigmaRad = DegToRad(2);
// Directions within 15 degrees count as like: the range of chance angles.
constexpr double kAngleRangeRad = DegToRad(30);

// Of the prior that an edge looks unlike those of neighbouring views, among
// their weights.
constexpr double kWeightOfUnlike = 0.5;

// A normal density of which a sixth is three times as wide: shading, blur and
// nearby contours move some edges by more than noise does.
double WideTailedNormal(double x, double sigma) {
  const double z2 = (x / sigma) * (x / sigma);
  return (5.0 / 6 * std::exp(-z2 / 2) + 1.0 / 18 * std::exp(-z2 / 18)) /
         (sigma * std::sqrt(2 * kPi));
}

}  // namespace

Vote VoteWithSupport(const SupportFit& fit, double density) {
  const double real = kSeenAndDetected *
                      WideTailedNormal(fit.distance_px, fit.sigma_px) *
                      WideTailedNormal(fit.angle_rad, kAngleSigmaRad);
  const double chance = density / kAngleRangeRad;
  return {real / chance};
}

Vote VoteWithoutSupport() { return {}; }

double LogLikelihoodRatio(const Vote& vote) {
  return std::log(vote.position_ratio + 1 - kSeenAndDetected);
}

double AppearanceRatio(const Vote& vote,
                       const Votes& votes,
                       const std::vector<ViewNeighbor>& neighbors) {
  if (!vote.appearance) return 1;
  double sum = kWeightOfUnlike;
  double weights = kWeightOfUnlike;
  for (const ViewNeighbor& neighbor : neighbors) {
    const auto& other = votes[static_cast<std::size_t>(neighbor.view_idx)];
    if (!other || !other->appearance) continue;
    sum +=
        neighbor.weight * LikelihoodRatio(*vote.appearance, *other->appearance);
    weights += neighbor.weight;
  }
  return sum / weights;
}

double Evidence(const Votes& votes, const NeighborsByView& neighbors) {
  std::vector<double> logs(votes.size());
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (!votes[i]) continue;
    logs[i] =
        LogLikelihoodRatio({votes[i]->position_ratio *
                            AppearanceRatio(*votes[i], votes, neighbors[i])});
  }
  double evidence = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (!votes[i]) continue;
    double sum = logs[i];
    double weights = 1;
    for (const ViewNeighbor& neighbor : neighbors[i]) {
      const auto j = static_cast<std::size_t>(neighbor.view_idx);
      if (!votes[j]) continue;
      sum += neighbor.weight * logs[j];
      weights += neighbor.weight;
    }
    if (sum > 0) evidence += sum / weights;
  }
  return evidence;
}

std::vector<std::size_t> ByFallingEvidence(const std::vector<Edge3d>& edges) {
  std::vector<std::size_t> order(edges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) {
    // Ties must not depend on the last bits of sums.
    const double rounded = std::round(1e6 * edges[i].evidence);
    const Eigen::Vector3d& x = edges[i].position;
    return std::tuple(-rounded, x.x(), x.y(), x.z());
  });
  return order;
}

}  // namespace curvix
