// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/sketch_input.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cstddef>
#include <vector>

namespace curvix {
namespace {

struct ContourSize {
  int num_edges = 0;
  float strength = 0;
};

// Contours one after the other.
EdgeMap MapOf(const std::vector<ContourSize>& contours) {
  EdgeMap map;
  for (const ContourSize& contour : contours) {
    for (int i = 0; i < contour.num_edges; ++i) {
      const auto edge_idx = static_cast<std::int32_t>(map.edges.size());
      map.edges.emplace_back().strength = contour.strength;
      EdgeNeighbors& neighbors = map.neighbors.emplace_back();
      if (i > 0) neighbors.previous = edge_idx - 1;
      if (i + 1 < contour.num_edges) neighbors.next = edge_idx + 1;
    }
  }
  return map;
}

// Whether all edges of the contour, or none, are among these.
bool IsCandidate(const std::vector<bool>& are_candidates,
                 const std::vector<ContourSize>& contours,
                 std::size_t contour_idx) {
  auto begin = are_candidates.begin();
  for (std::size_t i = 0; i < contour_idx; ++i) {
    begin += contours[i].num_edges;
  }
  const auto end = begin + contours[contour_idx].num_edges;
  EXPECT_EQ(std::count(begin, end, *begin), end - begin) << contour_idx;
  return *begin;
}

TEST(AreSeedCandidates, WeighsLengthAndStrength) {
  // Of 101 edges the median has strength 1.
  const std::vector<ContourSize> contours = {{51, 1},
                                             {5, 1},
                                             {6, 1},
                                             {1, 5.5F},
                                             {1, 6},
                                             {2, 3},
                                             {11, 0.5F},
                                             {12, 0.5F},
                                             {12, 0.25F}};
  const EdgeMap map = MapOf(contours);
  ASSERT_EQ(map.edges.size(), 101u);
  const std::vector<bool> are_candidates = AreSeedCandidates(map, {});
  const std::vector<bool> expected = {
      true, false, true, false, true, true, false, true, false};
  for (std::size_t i = 0; i < contours.size(); ++i) {
    EXPECT_EQ(IsCandidate(are_candidates, contours, i), expected[i]) << i;
  }
}

TEST(AreSeedCandidates, OfNoEdgesThereAreNone) {
  EXPECT_TRUE(AreSeedCandidates({}, {}).empty());
}

// What is asked for is in units of the image itself.
TEST(AreSeedCandidates, ContrastMakesNoDifference) {
  EdgeMap map = MapOf({{3, 1}, {7, 2}, {1, 9}, {20, 0.3F}, {40, 1}});
  const std::vector<bool> before = AreSeedCandidates(map, {});
  for (Edge2d& edge : map.edges) edge.strength *= 4;
  EXPECT_EQ(AreSeedCandidates(map, {}), before);
}

TEST(AreSeedCandidates, LeavesOutTexture) {
  EdgeMap map = MapOf({{20, 1}});
  map.edges[3].crowding = Eigen::half(0.4F);
  map.edges[4].crowding = Eigen::half(0.3F);
  Options options;
  options.curve_growth.max_crowding = 0.35;
  std::vector<bool> expected(20, true);
  expected[3] = false;
  EXPECT_EQ(AreSeedCandidates(map, options), expected);
  options.curve_growth.max_crowding = 0;
  EXPECT_EQ(AreSeedCandidates(map, options), std::vector<bool>(20, true));
}

}  // namespace
}  // namespace curvix
