// SPDX-License-Identifier: BSD-3-Clause
#include "curve_kinds/judge_kind.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "tests/support/random.h"

namespace curvix {
namespace {

// All directions were looked at, and say nothing.
SurfaceEvidence Undecided() {
  SurfaceEvidence evidence;
  for (auto& side : evidence.log_bayes) side.fill(0);
  return evidence;
}

DepthEvidence RandomEvidence(Random* random) {
  DepthEvidence evidence;
  for (SurfaceEvidence& at_depth : evidence) {
    for (auto& side : at_depth.log_bayes) {
      for (float& log : side) log = static_cast<float>(4 * random->Normal());
    }
  }
  return evidence;
}

TEST(JudgeKind, NothingSeenIsUnknown) {
  EXPECT_EQ(JudgeKind({}).kind, CurveKind::kUnknown);
  EXPECT_TRUE(DirectionsOfMarkings({}).none());
}

TEST(JudgeKind, OneSideOnlyIsABoundary) {
  DepthEvidence evidence;
  evidence.front().log_bayes[0].fill(0);
  EXPECT_EQ(JudgeKind(evidence).kind, CurveKind::kBoundary);
  EXPECT_EQ(JudgeKind(evidence).probability, 1);
}

TEST(JudgeKind, NoTextureIsProbablyACrease) {
  DepthEvidence evidence;
  evidence.front() = Undecided();
  EXPECT_EQ(JudgeKind(evidence).kind, CurveKind::kCrease);
  EXPECT_LT(JudgeKind(evidence).probability, 0.95);
}

TEST(JudgeKind, SurfaceBehindTurnsAMarkingIntoACrease) {
  DepthEvidence evidence;
  evidence.front() = Undecided();
  evidence.front().log_bayes[0][kNumDirections / 4] = 6;
  evidence.front().log_bayes[1][3 * kNumDirections / 4] = 6;
  EXPECT_EQ(JudgeKind(evidence).kind, CurveKind::kMarking);
  EXPECT_TRUE(DirectionsOfMarkings(evidence.front())[3 * kNumDirections / 4]);
  evidence[2].log_bayes[1][3 * kNumDirections / 4] = 12;
  EXPECT_EQ(JudgeKind(evidence).kind, CurveKind::kCrease);
}

TEST(JudgeKind, DoesNotDependOnTheOrderOfTheSides) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    DepthEvidence evidence = RandomEvidence(&random);
    const KindProbability kind = JudgeKind(evidence);
    for (SurfaceEvidence& at_depth : evidence) {
      std::swap(at_depth.log_bayes[0], at_depth.log_bayes[1]);
    }
    EXPECT_EQ(JudgeKind(evidence).kind, kind.kind);
    EXPECT_NEAR(JudgeKind(evidence).probability, kind.probability, 1e-9);
  }
}

TEST(JudgeKind, SumOfOnePlaceKeepsTheDirectionsThatItSees) {
  Random random(2);
  std::vector<DepthEvidence> evidence = {RandomEvidence(&random), {}};
  const DepthEvidence sum = SumOver({0}, evidence);
  EXPECT_NEAR(sum[1].log_bayes[0][3] / sum[0].log_bayes[1][5],
              evidence[0][1].log_bayes[0][3] / evidence[0][0].log_bayes[1][5],
              1e-4);
  EXPECT_EQ(JudgeKind(SumOver({1}, evidence)).kind, CurveKind::kUnknown);
}

}  // namespace
}  // namespace curvix
