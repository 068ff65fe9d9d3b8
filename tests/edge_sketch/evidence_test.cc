// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/evidence.h"

#include <gtest/gtest.h>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "base/angles.h"

namespace curvix {
namespace {

using Neighbors = NeighborsByView;

// A row of views, each next to the one before and the one after.
Neighbors Row(std::size_t size, double weight) {
  Neighbors neighbors(size);
  for (std::size_t i = 0; i + 1 < size; ++i) {
    neighbors[i].push_back({static_cast<int>(i) + 1, weight});
    neighbors[i + 1].push_back({static_cast<int>(i), weight});
  }
  return neighbors;
}

Votes RowOfVotes(std::initializer_list<double> votes) {
  return Votes(votes.begin(), votes.end());
}

TEST(VoteWithSupport, FallsWithDistanceAngleAndDensity) {
  const SupportFit fit{0.1, 0.15, DegToRad(1)};
  const double vote = VoteWithSupport(fit, 0.02);
  EXPECT_LT(VoteWithSupport({0.3, 0.15, DegToRad(1)}, 0.02), vote);
  EXPECT_LT(VoteWithSupport({0.1, 0.15, DegToRad(5)}, 0.02), vote);
  EXPECT_LT(VoteWithSupport(fit, 0.2), vote);
  EXPECT_EQ(VoteWithSupport({-0.1, 0.15, DegToRad(1)}, 0.02), vote);
}

TEST(VoteWithSupport, SpeaksForAGoodFitAndNeverBelowNoSupport) {
  EXPECT_GT(VoteWithSupport({0, 0.15, 0}, 0.02), 3);
  EXPECT_GE(VoteWithSupport({100, 0.15, 1.5}, 10), VoteWithoutSupport());
  EXPECT_LT(VoteWithoutSupport(), 0);
}

// With the shares q and 1 - q of real edges that are seen and missed, the
// likelihood ratio of a chance support averages 1: votes are calibrated.
TEST(VoteWithSupport, AveragesALikelihoodRatioOfOneOverChanceSupport) {
  const double sigma_px = 0.2, density = 0.01;
  const double gate_px = 10, gate_rad = DegToRad(15);
  // The gate holds an edge with chance p; places and directions are uniform.
  double sum = 0;
  const int steps = 400;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const double r = gate_px * (2 * (i + 0.5) / steps - 1);
      const double a = gate_rad * (2 * (j + 0.5) / steps - 1);
      const double ratio =
          std::exp(VoteWithSupport({r, sigma_px, std::abs(a)}, density));
      sum += ratio / (steps * steps);
    }
  }
  const double chance = 2 * gate_px * density;
  const double without = std::exp(VoteWithoutSupport());
  EXPECT_NEAR(chance * sum + (1 - chance) * without, 1, 0.05);
}

TEST(Evidence, AddsUpVotesOfViewsWithoutNeighbors) {
  EXPECT_DOUBLE_EQ(Evidence(RowOfVotes({2, 3, 4}), Row(3, 0)), 9);
  EXPECT_DOUBLE_EQ(Evidence({}, {}), 0);
}

TEST(Evidence, LeavesOutViewsThatWereNotAsked) {
  Votes votes = RowOfVotes({2, -2, 4});
  votes[1].reset();
  EXPECT_DOUBLE_EQ(Evidence(votes, Row(3, 1)), 6);
}

TEST(Evidence, IsNeverNegative) {
  EXPECT_DOUBLE_EQ(Evidence(RowOfVotes({-2, -2, -1}), Row(3, 1)), 0);
}

TEST(Evidence, AgreesWithAWorkedExample) {
  // (4 + 0.5 * 2) / 1.5, (2 + 0.5 * (4 - 2)) / 2, (-2 + 0.5 * 2) / 1.5 < 0.
  EXPECT_DOUBLE_EQ(Evidence(RowOfVotes({4, 2, -2}), Row(3, 0.5)),
                   5 / 1.5 + 3 / 2.0);
}

TEST(Evidence, PrefersRegionsToScatteredSupport) {
  const Neighbors neighbors = Row(8, 0.9);
  const double region =
      Evidence(RowOfVotes({3, 3, 3, 3, -2, -2, -2, -2}), neighbors);
  const double scattered =
      Evidence(RowOfVotes({3, -2, 3, -2, 3, -2, 3, -2}), neighbors);
  EXPECT_GT(region, 2 * scattered);
}

TEST(Evidence, ForgivesMissingSupportFarFromAllSupporters) {
  const double few = Evidence(RowOfVotes({3, 3, 3, -2, -2}), Row(5, 0.9));
  const double many =
      Evidence(RowOfVotes({3, 3, 3, -2, -2, -2, -2, -2}), Row(8, 0.9));
  EXPECT_DOUBLE_EQ(many, few);
}

}  // namespace
}  // namespace curvix
