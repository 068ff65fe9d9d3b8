// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/select_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "tests/support/synthetic_edges.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

ViewOverlap Overlap(int other,
                    double angle_deg = 20,
                    double share = 1,
                    const Vector3d& across = {1, 0, 0}) {
  return {other, share, DegToRad(angle_deg), across};
}

// Every view overlaps every other.
Overlaps AllOverlap(int num_views) {
  Overlaps overlaps;
  for (int i = 0; i < num_views; ++i) {
    auto& row = overlaps.emplace_back();
    for (int j = 0; j < num_views; ++j) {
      if (j != i) row.push_back(Overlap(j));
    }
  }
  return overlaps;
}

void ExpectPair(const std::optional<ViewPair>& pair, int h1, int h2) {
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->h1, h1);
  EXPECT_EQ(pair->h2, h2);
}

TEST(NextViewPair, TakesTheViewsWithMostUnusedEdgesTheFullerFirst) {
  ExpectPair(NextViewPair(AllOverlap(4), {10, 30, 20, 40}, {}, {}), 3, 1);
}

TEST(NextViewPair, BreaksTiesBySmallerH1ThenSmallerH2) {
  ExpectPair(NextViewPair(AllOverlap(4), {5, 5, 5, 5}, {}, {}), 0, 1);
  ExpectPair(NextViewPair(AllOverlap(4), {5, 9, 5, 5}, {}, {}), 1, 0);
  // (2, 0) and (1, 3) have 15 each; only these two overlap.
  const Overlaps overlaps = {
      {Overlap(2)}, {Overlap(3)}, {Overlap(0)}, {Overlap(1)}};
  ExpectPair(NextViewPair(overlaps, {5, 10, 10, 5}, {}, {}), 1, 3);
}

TEST(NextViewPair, LeavesOutPairsThatAreDoneEitherWayRound) {
  const auto overlaps = AllOverlap(3);
  std::vector<ViewPair> done = {{1, 0}};
  ExpectPair(NextViewPair(overlaps, {5, 5, 5}, done, {}), 0, 2);
  done.push_back({0, 2});
  ExpectPair(NextViewPair(overlaps, {5, 5, 5}, done, {}), 1, 2);
  done.push_back({2, 1});
  EXPECT_FALSE(NextViewPair(overlaps, {5, 5, 5}, done, {}));
}

TEST(NextViewPair, NeedsUnusedEdgesAndSoundOverlap) {
  EXPECT_FALSE(NextViewPair(AllOverlap(3), {0, 0, 0}, {}, {}));
  EXPECT_FALSE(NextViewPair({}, {}, {}, {}));
  const HypothesisOptions options;
  const auto with = [&](double angle_deg, double share) {
    return NextViewPair({{Overlap(1, angle_deg, share)}, {}}, {5, 5}, {}, {});
  };
  EXPECT_TRUE(with(20, 0.9));
  EXPECT_FALSE(with(20, 0.1));
  EXPECT_FALSE(with(options.min_ray_angle_deg - 0.1, 0.9));
  EXPECT_TRUE(with(options.min_ray_angle_deg + 0.1, 0.9));
  EXPECT_TRUE(with(options.max_ray_angle_deg - 0.1, 0.9));
  EXPECT_FALSE(with(options.max_ray_angle_deg + 0.1, 0.9));
}

TEST(SelectPartners, PrefersOverlapAndAMiddlingAngle) {
  HypothesisOptions options;
  options.num_partners = 1;
  EXPECT_THAT(
      SelectPartners({Overlap(1, 6), Overlap(2, 20), Overlap(3, 50)}, options),
      ElementsAre(2));
  EXPECT_THAT(
      SelectPartners({Overlap(1, 20, 0.4), Overlap(2, 20, 0.8)}, options),
      ElementsAre(2));
  EXPECT_THAT(SelectPartners({Overlap(4), Overlap(7)}, options),
              ElementsAre(4));
}

TEST(SelectPartners, TakesOnlySoundOverlapsAndEachOnce) {
  EXPECT_THAT(SelectPartners({Overlap(1, 2), Overlap(2, 80)}, {}), IsEmpty());
  EXPECT_THAT(SelectPartners({Overlap(1, 20, 0.05)}, {}), IsEmpty());
  EXPECT_THAT(SelectPartners({}, {}), IsEmpty());
  HypothesisOptions many;
  many.num_partners = 10;
  EXPECT_THAT(SelectPartners({Overlap(3), Overlap(5)}, many),
              ElementsAre(3, 5));
}

TEST(SelectPartners, PrefersBaselinesInDifferentDirections) {
  HypothesisOptions options;
  options.num_partners = 2;
  const auto partners =
      SelectPartners({Overlap(1, 20, 1, {1, 0, 0}),
                      Overlap(2, 20, 0.95, Vector3d(-1, 0.1, 0).normalized()),
                      Overlap(3, 20, 0.6, {0, 1, 0})},
                     options);
  EXPECT_THAT(partners, ElementsAre(1, 3));
}

TEST(SelectPartners, CrossesBaselinesOnAGridOfCameras) {
  std::vector<PosedView> views;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      views.push_back(
          MakeView(Eigen::Matrix3d::Identity(), {1.0 * column, 1.0 * row, 0}));
    }
  }
  HypothesisOptions options;
  options.num_partners = 2;
  const auto overlaps = FindOverlaps(views, {});
  for (const auto& others : overlaps) {
    const std::vector<int> partners = SelectPartners(others, options);
    ASSERT_EQ(partners.size(), 2u);
    std::vector<Vector3d> across;
    for (const int partner : partners) {
      for (const ViewOverlap& overlap : others) {
        if (overlap.other == partner) across.push_back(overlap.baseline_across);
      }
    }
    EXPECT_GT(RadToDeg(std::acos(std::abs(across[0].dot(across[1])))), 40);
  }
}

}  // namespace
}  // namespace curvix
