// SPDX-License-Identifier: BSD-3-Clause
#include "poses/held_out.h"

#include <gtest/gtest.h>
#include <array>
#include <cmath>

#include "tests/support/random.h"

namespace curvix {
namespace {

std::vector<Eigen::Vector3d> RandomPositions(int count) {
  Random random(5);
  std::vector<Eigen::Vector3d> positions;
  for (int i = 0; i < count; ++i) positions.push_back(random.NormalVector());
  return positions;
}

TEST(SpaceCells, AreInFiveSetsWhateverTheUnit) {
  const std::vector<Eigen::Vector3d> positions = RandomPositions(5000);
  std::vector<Eigen::Vector3d> in_other_unit;
  for (const auto& x : positions) in_other_unit.push_back(1024 * x);
  const SpaceCells cells(positions), others(in_other_unit);
  std::array<int, 5> counts{};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const int set = cells.SetOf(positions[i]);
    ASSERT_GE(set, 0);
    ASSERT_LT(set, 5);
    ++counts[static_cast<std::size_t>(set)];
    EXPECT_EQ(set, others.SetOf(in_other_unit[i]));
  }
  for (const int count : counts) EXPECT_NEAR(count, 1000, 100);
}

TEST(SpaceCells, EverySetMayBeTheFirst) {
  const std::vector<Eigen::Vector3d> positions = RandomPositions(100);
  const SpaceCells cells(positions);
  for (const Eigen::Vector3d& x : positions) {
    EXPECT_EQ(cells.StartingWith(cells.SetOf(x)).SetOf(x), 0);
    EXPECT_EQ(cells.StartingWith(2).CellOf(x), cells.CellOf(x));
  }
}

TEST(GainsByCell, OfSeveralSetsAddUp) {
  const std::vector<Eigen::Vector3d> positions = RandomPositions(100);
  const SpaceCells cells(positions);
  GainsByCell all(cells), sum(cells);
  for (int set = 0; set < SpaceCells::kNumSets; ++set) {
    GainsByCell of_set(cells.StartingWith(set));
    for (const Eigen::Vector3d& x : positions) {
      if (cells.SetOf(x) == set) of_set.Add(x, 1 + x.x());
    }
    sum.Add(of_set);
  }
  for (const Eigen::Vector3d& x : positions) all.Add(x, 1 + x.x());
  EXPECT_NEAR(
      SignificanceOf(sum.Normalized()), SignificanceOf(all.Normalized()), 1e-9);
}

TEST(HoldOutMore, LeavesTwoFifthsOfSpace) {
  const std::vector<Eigen::Vector3d> positions = RandomPositions(5000);
  const SpaceCells cells(positions);
  PoseObservationSet observations;
  for (const Eigen::Vector3d& x : positions) {
    observations.places.emplace_back().contour.axis.position = x;
    observations.points.emplace_back().position = x;
  }
  const std::vector<CurvePlace> first =
      TakeHeldOut(cells, &observations.places);
  EXPECT_NEAR(static_cast<double>(first.size()), 1000, 100);
  const PoseObservationSet held_out =
      HoldOutMore(cells, {first, {}}, &observations);
  EXPECT_EQ(held_out.places.size() + observations.places.size(), 5000u);
  EXPECT_EQ(held_out.points.size() + observations.points.size(), 5000u);
  EXPECT_NEAR(static_cast<double>(observations.points.size()), 2000, 200);
  EXPECT_EQ(observations.places.size(), observations.points.size());
  for (const Eigen::Vector3d& x : PositionsOf(observations)) {
    EXPECT_GE(cells.SetOf(x), 3);
  }
  for (const Eigen::Vector3d& x : PositionsOf(held_out)) {
    EXPECT_LT(cells.SetOf(x), 3);
  }
}

// All signs of n gains are positive once in 2^n times.
TEST(SignificanceOf, IsExactIfNoneLoses) {
  for (const std::size_t n : {1u, 5u, 20u}) {
    const double z = SignificanceOf(std::vector<double>(n, 0.1));
    EXPECT_NEAR(std::exp(-z * z / 2), std::pow(0.5, n), 1e-9);
  }
}

TEST(SignificanceOf, IsAtLeastTheSumOverTheRootOfSquares) {
  Random random(8);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<double> gains;
    double sum = 0, squares = 0;
    for (int i = 0; i < 30; ++i) {
      gains.push_back(0.3 + random.Normal());
      sum += gains.back();
      squares += gains.back() * gains.back();
    }
    const double z = SignificanceOf(gains);
    EXPECT_GE(std::abs(z), std::abs(sum) / std::sqrt(squares) - 1e-9);
    EXPECT_EQ(z > 0, sum > 0);
    for (double& gain : gains) gain *= -7;
    EXPECT_NEAR(SignificanceOf(gains), -z, 1e-9);
  }
}

// Gains of many items that are as often losses, those of a cell being the same:
// significant once in nine thousand times at most, however many items a cell
// has.
TEST(GainsByCell, CallsChanceSignificantOnceInNineThousandTimes) {
  const std::vector<Eigen::Vector3d> positions = RandomPositions(300);
  const SpaceCells cells(positions);
  Random random(6);
  constexpr int kNumTrials = 10000;
  int num_significant = 0;
  for (int trial = 0; trial < kNumTrials; ++trial) {
    std::map<SpaceCells::Cell, double> gain_of_cell;
    GainsByCell gains(cells);
    for (const Eigen::Vector3d& x : positions) {
      const auto [at, is_new] = gain_of_cell.try_emplace(cells.CellOf(x), 0);
      if (is_new) at->second = std::pow(random.Normal(), 3);
      gains.Add(x, at->second);
    }
    num_significant += SignificanceOf(gains.Normalized()) >= kSignificant;
  }
  EXPECT_LE(num_significant, kNumTrials / 9000);
}

TEST(GainsByCell, SeesASmallGainOfManyCells) {
  const std::vector<Eigen::Vector3d> positions = RandomPositions(2000);
  const SpaceCells cells(positions);
  Random random(7);
  GainsByCell gains(cells);
  for (const Eigen::Vector3d& x : positions) {
    gains.Add(x, 0.2 + random.Normal());
  }
  EXPECT_GT(SignificanceOf(gains.Normalized()), kSignificant);
}

TEST(GainsByCell, IsNoneWithoutGains) {
  const SpaceCells cells({});
  EXPECT_EQ(SignificanceOf(GainsByCell(cells).Normalized()), 0);
}

TEST(PairErrors, TakesViewsWithAnEdgeBeforeOrAfter) {
  HeldOutErrors before, after;
  before.places = {{{2, 0.1}, {5, 0.2}}, {}};
  after.places = {{{1, 0.4}, {5, 0.3}}, {{0, 0.5}}};
  std::vector<std::vector<double>> pairs;
  for (const ErrorPair& pair : PairErrors(before, after)) {
    pairs.push_back({static_cast<double>(pair.place_idx),
                     static_cast<double>(pair.view_idx),
                     pair.before,
                     pair.after});
  }
  EXPECT_EQ(
      pairs,
      (std::vector<std::vector<double>>{
          {0, 1, 1, 0.4}, {0, 2, 0.1, 1}, {0, 5, 0.2, 0.3}, {1, 0, 1, 0.5}}));
}

TEST(FallOfErrors, IsThatOfPlacesOrPoints) {
  HeldOutErrors before, after;
  before.places = {{{0, 0.5}, {1, 0.5}}};
  after.places = {{{0, 0.3}, {1, 0.3}}};
  EXPECT_NEAR(FallOfErrors(before, after), 0.4, 1e-12);
  before.points = after.points = {{1.3}, {1.3, 1.3}};
  EXPECT_NEAR(FallOfErrors(before, after), 0.4, 1e-12);
  after.points = {{0.5}, {0.5, 0.5}};
  EXPECT_NEAR(FallOfErrors(before, after), 1.2, 1e-12);
  EXPECT_EQ(FallOfErrors(after, before), 0) << "both rise";
}

TEST(IsShiftTooLarge, BeyondHalfAPixelAndFourTimesTheFall) {
  EXPECT_FALSE(IsShiftTooLarge(0.4, 0)) << "harmless";
  EXPECT_FALSE(IsShiftTooLarge(1, 0.3));
  EXPECT_TRUE(IsShiftTooLarge(1, 0.2));
}

TEST(IsBetter, MayAskLess) {
  EXPECT_TRUE(IsBetter({0, 2, 1}, 1));
  EXPECT_FALSE(IsBetter({1, 1, 0.9}, 1));
  EXPECT_FALSE(IsBetter({-3, 10, 5}, 1));
}

TEST(IsBetter, AsksBothKinds) {
  EXPECT_TRUE(IsBetter({3, 3, 4.3}));
  EXPECT_FALSE(IsBetter({-3, 10, 5}));  // places tell the contrary
  EXPECT_FALSE(IsBetter({2, 2, 2.8}));
}

TEST(MayBecomeBetter, IfTheOtherSetsGainAlike) {
  EXPECT_TRUE(MayBecomeBetter({1, 1, 2}, 1));
  EXPECT_FALSE(MayBecomeBetter({1, 1, 2}, 2));
  EXPECT_FALSE(MayBecomeBetter({-3, 9, 4}, 1));  // places tell the contrary
  EXPECT_TRUE(MayBecomeBetter({4, 4, kSignificant}, SpaceCells::kNumSets));
}

TEST(WorseViews, AreThoseThatLoseBeyondChance) {
  std::vector<ErrorPair> pairs;
  for (std::size_t i = 0; i < 10; ++i) {
    pairs.push_back({i, 0, 0.1, 0.3});
    pairs.push_back({i, 1, 0.3, 0.1});
    pairs.push_back({i, 2, 0.2, i % 2 == 0 ? 0.1 : 0.3});
  }
  EXPECT_EQ(WorseViews(pairs, 4),
            (std::vector<bool>{true, false, false, false}));
}

TEST(ChoosePoints, HoldsOutEveryFifthAndWhatNoViewNeeds) {
  std::vector<PointSample> points(12000);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].position = {static_cast<double>(i), 0, 0};
    points[i].observations.resize(i % 2 == 0 ? 3 : 2);
    for (std::size_t k = 0; k < points[i].observations.size(); ++k) {
      points[i].observations[k].view_idx = static_cast<std::int32_t>(k);
    }
  }
  const ChosenPoints chosen = ChoosePoints(points, 3, 0);
  EXPECT_EQ(chosen.chosen.size() + chosen.held_out.size(), points.size());
  EXPECT_EQ(chosen.chosen.size(), 2000u);
  for (const PointSample& point : chosen.chosen) {
    EXPECT_EQ(point.observations.size(), 3u);  // those that most views see
  }
}

}  // namespace
}  // namespace curvix
