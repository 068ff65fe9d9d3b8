// SPDX-License-Identifier: BSD-3-Clause
#include "model/contours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

namespace curvix {
namespace {

using ::testing::ElementsAre;

TEST(Contours, FollowMutualLinksOnly) {
  // 0 <-> 2 <-> 1 from start to end; 3 points at 1, which does not answer;
  // 4 <-> 5 is closed.
  std::vector<EdgeNeighbors> neighbors(6);
  neighbors[0].next = 2;
  neighbors[2] = {0, 1};
  neighbors[1].previous = 2;
  neighbors[3].previous = 1;
  neighbors[4] = {5, 5};
  neighbors[5] = {4, 4};
  const Contours contours(neighbors);
  ASSERT_EQ(contours.size(), 3u);
  EXPECT_THAT(contours[0], ElementsAre(0, 2, 1));
  EXPECT_THAT(contours[1], ElementsAre(3));
  EXPECT_THAT(contours[2], ElementsAre(4, 5));
  EXPECT_EQ(Contours({}).size(), 0u);
}

TEST(Contours, RunFromOneEndToTheOther) {
  // 5 -> 3 -> 0 -> 4 -> 1, and 2 alone.
  std::vector<EdgeNeighbors> neighbors(6);
  const std::vector<std::int32_t> order = {5, 3, 0, 4, 1};
  for (std::size_t k = 1; k < order.size(); ++k) {
    neighbors[static_cast<std::size_t>(order[k - 1])].next = order[k];
    neighbors[static_cast<std::size_t>(order[k])].previous = order[k - 1];
  }
  const Contours contours(neighbors);
  ASSERT_EQ(contours.size(), 2u);
  EXPECT_THAT(contours[0], ElementsAre(5, 3, 0, 4, 1));
  EXPECT_THAT(contours[1], ElementsAre(2));
}

// A link to a contour's first edge that it does not answer closes nothing.
TEST(Contours, AreClosedByMutualLinksOnly) {
  std::vector<EdgeNeighbors> neighbors(3);
  neighbors[0] = {1, 2};
  neighbors[1].next = 0;
  neighbors[2] = {0, 0};
  const Contours contours(neighbors);
  ASSERT_EQ(contours.size(), 1u);
  EXPECT_THAT(contours[0], ElementsAre(1, 0, 2));
}

}  // namespace
}  // namespace curvix
