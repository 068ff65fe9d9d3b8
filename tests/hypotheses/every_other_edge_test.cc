// SPDX-License-Identifier: BSD-3-Clause
#include "hypotheses/every_other_edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

namespace curvix {
namespace {

using EdgeIdxs = std::vector<std::int32_t>;

// A contour through all of `num_edges`, from the first to the last.
std::vector<EdgeNeighbors> Contour(std::int32_t num_edges) {
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

TEST(EveryOtherAlongContours, TakesEveryOtherEdgeOfAContour) {
  EXPECT_EQ(EveryOtherAlongContours(UpTo(5), Contour(5)), (EdgeIdxs{0, 2, 4}));
}

TEST(EveryOtherAlongContours, CountsOnlyTheEdgesThatAreGiven) {
  EXPECT_EQ(EveryOtherAlongContours({1, 2, 4}, Contour(5)), (EdgeIdxs{1, 4}));
}

TEST(EveryOtherAlongContours, TakesEdgesWithoutNeighbors) {
  const std::vector<EdgeNeighbors> none(3);
  EXPECT_EQ(EveryOtherAlongContours(UpTo(3), none), UpTo(3));
}

// Links that cross, meet, and go one way only.
TEST(EveryOtherAlongContours, LeavesOutOnlyEdgesThatLinkToOneThatIsTaken) {
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
  const EdgeIdxs taken = EveryOtherAlongContours(UpTo(kNumEdges), neighbors);
  for (std::int32_t i = 0; i < kNumEdges; ++i) {
    const auto at = std::lower_bound(taken.begin(), taken.end(), i);
    const bool is_taken = at != taken.end() && *at == i;
    EXPECT_EQ(is_taken, !links_to(i, EdgeIdxs(taken.begin(), at))) << i;
  }
}

}  // namespace
}  // namespace curvix
