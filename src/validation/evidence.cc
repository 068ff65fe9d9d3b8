// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "validation/evidence.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/angles.h"

namespace curvix {
namespace {

constexpr double kSeenAndDetected = 0.9;  // q
// Standard deviation of third-order orientations.
constexpr double kAngleSigmaRad = DegToRad(2);
// Directions within 15 degrees count as like: the range of chance angles.
constexpr double kAngleRangeRad = DegToRad(30);

// A normal density of which a sixth is three times as wide: shading, blur and
// nearby contours move some edges by more than noise does.
double WideTailedNormal(double x, double sigma) {
  const double z2 = (x / sigma) * (x / sigma);
  return (5.0 / 6 * std::exp(-z2 / 2) + 1.0 / 18 * std::exp(-z2 / 18)) /
         (sigma * std::sqrt(2 * kPi));
}

}  // namespace

double VoteWithSupport(const SupportFit& fit, double density) {
  const double real = kSeenAndDetected *
                      WideTailedNormal(fit.distance_px, fit.sigma_px) *
                      WideTailedNormal(fit.angle_rad, kAngleSigmaRad);
  const double chance = density / kAngleRangeRad;
  return std::log(real / chance + 1 - kSeenAndDetected);
}

double VoteWithoutSupport() { return std::log(1 - kSeenAndDetected); }

double Evidence(const Votes& votes,
                const std::vector<std::vector<ViewNeighbor>>& neighbors) {
  double evidence = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (!votes[i]) continue;
    double sum = votes[i]->vote;
    double weights = 1;
    for (const ViewNeighbor& neighbor : neighbors[i]) {
      const auto& vote = votes[static_cast<std::size_t>(neighbor.view_idx)];
      if (!vote) continue;
      sum += neighbor.weight * vote->vote;
      weights += neighbor.weight;
    }
    if (sum > 0) evidence += sum / weights;
  }
  return evidence;
}

double InformationShare(
    const Votes& votes,
    const std::vector<std::vector<ViewNeighbor>>& neighbors) {
  Eigen::Matrix2d told = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d expected = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (!votes[i]) continue;
    const Eigen::Matrix2d information =
        votes[i]->gradient * votes[i]->gradient.transpose();
    double share = votes[i]->weight;
    told += share * information;
    for (const ViewNeighbor& neighbor : neighbors[i]) {
      const auto& vote = votes[static_cast<std::size_t>(neighbor.view_idx)];
      if (vote) share = std::max(share, neighbor.weight * vote->weight);
    }
    expected += share * information;
  }
  if (!(expected.determinant() > 0)) return 0;
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d>(
             told, expected, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
}

}  // namespace curvix
