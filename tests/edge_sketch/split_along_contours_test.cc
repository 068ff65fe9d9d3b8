// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/sketch_input.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

namespace curvix {
namespace {

using EdgeIdxs = std::vector<std::int32_t>;

// A contour through all of `num_edges`, from the first to the last.
std::vector<EdgeNeighbors> ContourThrough(std::int32_t num_edges) {
  std::vector<EdgeNeighbors> neighbors(static_cast<std::size_t>(num_edges));
  for (std::int32_t i = 0; i + 1 < num_edges; ++i) {
    neighbors[static_cast<std::size_t>(i)].next = i + 1;
    neighbors[static_cast<std::size_t>(i) + 1].previous = i;
  }
  return neighbors;
}

EdgeIdxs UpTo(std::int32_t num_edges) {
  EdgeIdxs edge_idxs(static_cast<std::size_t>(num_edges));
  std::iota(edge_idxs.begin(), edge_idxs.end(), 0);
  return edge_idxs;
}

TEST(SplitAlongContours, TakesEveryOtherEdgeOfAContourFirst) {
  const TwoTurns turns = SplitAlongContours(UpTo(5), ContourThrough(5), 2);
  EXPECT_EQ(turns.first, (EdgeIdxs{0, 2, 4}));
  EXPECT_EQ(turns.second, (EdgeIdxs{1, 3}));
}

TEST(SplitAlongContours, TakesFewerWithALargerStep) {
  const TwoTurns turns = SplitAlongContours(UpTo(10), ContourThrough(10), 4);
  EXPECT_EQ(turns.first, (EdgeIdxs{0, 4, 8}));
  EXPECT_EQ(turns.second, (EdgeIdxs{1, 2, 3, 5, 6, 7, 9}));
}

TEST(SplitAlongContours, CountsOnlyTheEdgesThatAreAsked) {
  const TwoTurns turns = SplitAlongContours({1, 2, 4}, ContourThrough(5), 2);
  EXPECT_EQ(turns.first, (EdgeIdxs{1, 4}));
  EXPECT_EQ(turns.second, (EdgeIdxs{2}));
}

TEST(SplitAlongContours, TakesEdgesWithoutNeighborsFirst) {
  const std::vector<EdgeNeighbors> none(3);
  const TwoTurns turns = SplitAlongContours(UpTo(3), none, 2);
  EXPECT_EQ(turns.first, UpTo(3));
  EXPECT_TRUE(turns.second.empty());
}

// Links that cross, meet, and go one way only.
TEST(SplitAlongContours, LeavesEachEdgeOfTheSecondTurnNextToOneOfTheFirst) {
  constexpr std::int32_t kNumEdges = 101;
  std::vector<EdgeNeighbors> neighbors(kNumEdges);
  const auto links_to = [&](std::int32_t i, const EdgeIdxs& others) {
    const EdgeNeighbors& links = neighbors[static_cast<std::size_t>(i)];
    const auto is_other = [&](const std::optional<std::int32_t>& link) {
      return link && std::binary_search(others.begin(), others.end(), *link);
    };
    return is_other(links.previous) || is_other(links.next);
  };
  for (std::int32_t i = 0; i < kNumEdges; ++i) {
    EdgeNeighbors& links = neighbors[static_cast<std::size_t>(i)];
    if (i % 3 != 0) links.previous = (i * 37 + 11) % kNumEdges;
    if (i % 5 != 0) links.next = (i * 53 + 29) % kNumEdges;
  }
  const TwoTurns turns = SplitAlongContours(UpTo(kNumEdges), neighbors, 2);
  EdgeIdxs all = turns.first;
  all.insert(all.end(), turns.second.begin(), turns.second.end());
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, UpTo(kNumEdges));
  for (const std::int32_t i : turns.second) {
    EXPECT_TRUE(links_to(i, turns.first)) << i;
  }
  for (auto i = turns.first.begin(); i != turns.first.end(); ++i) {
    EXPECT_FALSE(links_to(*i, EdgeIdxs(turns.first.begin(), i))) << *i;
  }
}

}  // namespace
}  // namespace curvix
