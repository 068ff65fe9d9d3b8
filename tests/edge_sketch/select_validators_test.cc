// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/select_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <vector>

#include "base/angles.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

DistinctViews Ring(std::size_t num_views) {
  return AllDistinct(
      FindOverlaps(RingOfViews(static_cast<int>(num_views)), {}));
}

TEST(SelectValidators, TakesAllOfFewViews) {
  EXPECT_THAT(SelectValidators(Ring(5), 3, {1}, 5), ElementsAre(0, 1, 2, 3, 4));
}

TEST(SelectValidators, TakesNoneThatIsRepeated) {
  DistinctViews views = Ring(5);
  views.overlaps[1].clear();
  views.are_repeated[2] = true;
  EXPECT_THAT(SelectValidators(views, 3, {4}, 5), ElementsAre(0, 1, 3, 4));
}

TEST(SelectValidators, SpreadsThemOverAllDirections) {
  const auto chosen = SelectValidators(Ring(200), 7, {17, 197}, 25);
  EXPECT_THAT(chosen, SizeIs(25));
  EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
  for (const int must : {7, 17, 197}) EXPECT_THAT(chosen, Contains(must));
  // 25 of 200 are 8 apart; halving gaps leaves none twice as wide.
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const int next = chosen[(i + 1) % chosen.size()];
    const int gap = (next - chosen[i] + 200) % 200;
    EXPECT_LE(gap, 16) << chosen[i];
    EXPECT_GE(gap, 2) << chosen[i];
  }
}

TEST(SelectValidators, TakesOneViewOfAStationFirst) {
  DistinctViews views = Ring(20);
  // Those of a station do not overlap.
  views.stations[8] = views.stations[9] = 7;
  for (const std::size_t i : {7, 8, 9}) {
    std::erase_if(views.overlaps[i], [](const ViewOverlap& overlap) {
      return overlap.other >= 7 && overlap.other <= 9;
    });
  }
  EXPECT_THAT(SelectValidators(views, 0, {7}, 18), SizeIs(18));
  for (const int mate : {8, 9}) {
    EXPECT_THAT(SelectValidators(views, 0, {7}, 18), Not(Contains(mate)));
  }
}

TEST(SelectValidators, TakesThoseThatAreQueriedInTheirStead) {
  DistinctViews views = Ring(20);
  views.before_at_station[3] = {1, 2};
  const auto chosen = SelectValidators(views, 3, {10}, 2);
  EXPECT_THAT(chosen, ElementsAre(1, 2, 3, 10));
}

TEST(SelectValidators, TakesViewsThatOverlapOnly) {
  DistinctViews views = Ring(20);
  std::erase_if(views.overlaps[4],
                [](const ViewOverlap& overlap) { return overlap.other > 9; });
  for (const int view_idx : SelectValidators(views, 4, {}, 12)) {
    EXPECT_LE(view_idx, 9);
  }
}

TEST(OverlapsAmong, KeepsWhatConcernsTheChosenOnly) {
  const Overlaps overlaps = Ring(6).overlaps;
  const auto among = OverlapsAmong(overlaps, {1, 2, 4});
  ASSERT_THAT(among, SizeIs(6));
  for (const std::size_t i : {0U, 3U, 5U}) EXPECT_THAT(among[i], IsEmpty());
  ASSERT_THAT(among[2], SizeIs(2));
  EXPECT_EQ(among[2][0].other, 1);
  EXPECT_EQ(among[2][1].other, 4);
  EXPECT_EQ(among[2][1].ray_angle_rad, overlaps[2][3].ray_angle_rad);
}

}  // namespace
}  // namespace curvix
