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

constexpr double kTolerance = 1e-12;  // of exp() and log()

double LogWithSupport(const SupportFit& fit, double density) {
  return LogLikelihoodRatio(VoteWithSupport(fit, density));
}

double LogWithoutSupport() { return LogLikelihoodRatio(VoteWithoutSupport()); }

Votes RowOfVotes(std::initializer_list<double> logs) {
  Votes votes;
  for (const double log : logs) {
    votes.push_back(Vote{std::exp(log) - std::exp(LogWithoutSupport())});
  }
  return votes;
}

TEST(VoteWithSupport, FallsWithDistanceAngleAndDensity) {
  const SupportFit fit{0.1, 0.15, DegToRad(1)};
  const double vote = LogWithSupport(fit, 0.02);
  EXPECT_LT(LogWithSupport({0.3, 0.15, DegToRad(1)}, 0.02), vote);
  EXPECT_LT(LogWithSupport({0.1, 0.15, DegToRad(5)}, 0.02), vote);
  EXPECT_LT(LogWithSupport(fit, 0.2), vote);
  EXPECT_EQ(LogWithSupport({-0.1, 0.15, DegToRad(1)}, 0.02), vote);
}

TEST(VoteWithSupport, SpeaksForAGoodFitAndNeverBelowNoSupport) {
  EXPECT_GT(LogWithSupport({0, 0.15, 0}, 0.02), 3);
  EXPECT_GE(LogWithSupport({100, 0.15, 1.5}, 10), LogWithoutSupport());
  EXPECT_LT(LogWithoutSupport(), 0);
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
          std::exp(LogWithSupport({r, sigma_px, std::abs(a)}, density));
      sum += ratio / (steps * steps);
    }
  }
  const double chance = 2 * gate_px * density;
  const double without = std::exp(LogWithoutSupport());
  EXPECT_NEAR(chance * sum + (1 - chance) * without, 1, 0.05);
}

TEST(Evidence, AddsUpVotesOfViewsWithoutNeighbors) {
  EXPECT_NEAR(Evidence(RowOfVotes({2, 3, 4}), Row(3, 0)), 9, kTolerance);
  EXPECT_DOUBLE_EQ(Evidence({}, {}), 0);
}

TEST(Evidence, LeavesOutViewsThatWereNotAsked) {
  Votes votes = RowOfVotes({2, -2, 4});
  votes[1].reset();
  EXPECT_NEAR(Evidence(votes, Row(3, 1)), 6, kTolerance);
}

TEST(Evidence, IsNeverNegative) {
  EXPECT_DOUBLE_EQ(Evidence(RowOfVotes({-2, -2, -1}), Row(3, 1)), 0);
}

TEST(Evidence, AgreesWithAWorkedExample) {
  // (4 + 0.5 * 2) / 1.5, (2 + 0.5 * (4 - 2)) / 2, (-2 + 0.5 * 2) / 1.5 < 0.
  EXPECT_NEAR(Evidence(RowOfVotes({4, 2, -2}), Row(3, 0.5)),
              5 / 1.5 + 3 / 2.0,
              kTolerance);
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

Vote VoteThatLooks(float level, float half_contrast) {
  Vote vote{10};
  vote.appearance = Appearance{level, half_contrast, 1e-4f};
  return vote;
}

TEST(AppearanceRatio, IsOneIfNothingIsKnown) {
  const std::vector<ViewNeighbor> neighbors = {{1, 1.0}};
  EXPECT_EQ(
      AppearanceRatio(Vote{10}, {Vote{10}, VoteThatLooks(100, 20)}, neighbors),
      1);
  const Vote vote = VoteThatLooks(100, 20);
  EXPECT_EQ(AppearanceRatio(vote, {vote, Vote{10}}, neighbors), 1);
  EXPECT_EQ(AppearanceRatio(vote, {vote, std::nullopt}, neighbors), 1);
}

TEST(AppearanceRatio, WeighsNeighborsAndThePriorOfNone) {
  const Vote vote = VoteThatLooks(100, 20);
  const Vote alike = VoteThatLooks(100, 20), unlike = VoteThatLooks(103, -4);
  const double ratio_alike =
      LikelihoodRatio(*vote.appearance, *alike.appearance);
  const double ratio_unlike =
      LikelihoodRatio(*vote.appearance, *unlike.appearance);
  EXPECT_NEAR(
      AppearanceRatio(vote, {vote, alike, unlike}, {{1, 0.7}, {2, 0.3}}),
      (0.5 + 0.7 * ratio_alike + 0.3 * ratio_unlike) / 1.5,
      kTolerance);
}

TEST(Evidence, IsLargerIfViewsShowTheSameLook) {
  const Votes known = {Vote{10}, Vote{10}, Vote{10}};
  const Votes alike(3, VoteThatLooks(100, 20));
  const Votes unlike = {
      VoteThatLooks(100, 20), VoteThatLooks(100, -20), VoteThatLooks(100, 20)};
  const Neighbors neighbors = Row(3, 0.8);
  EXPECT_GT(Evidence(alike, neighbors), Evidence(known, neighbors) + 1);
  EXPECT_LT(Evidence(unlike, neighbors), Evidence(known, neighbors) - 1);
}

}  // namespace
}  // namespace curvix
