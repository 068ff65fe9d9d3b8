// SPDX-License-Identifier: BSD-3-Clause
#include "model/neighborhood_graph.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace curvix {
namespace {

std::vector<NeighborLink> RowOf(const NeighborhoodGraph& graph, std::size_t i) {
  return {graph.Neighbors(i).begin(), graph.Neighbors(i).end()};
}

TEST(NeighborhoodGraph, HasNoEdgesByDefault) {
  EXPECT_EQ(NeighborhoodGraph().NumEdges(), 0u);
  EXPECT_EQ(NeighborhoodGraph::FromRows({}, 1), NeighborhoodGraph());
}

TEST(NeighborhoodGraph, KnowsALinkGivenAtOneEndAtBoth) {
  const auto graph = NeighborhoodGraph::FromRows({{}, {}, {{0, 2, 1}}}, 1);
  EXPECT_EQ(graph.NumEdges(), 3u);
  EXPECT_EQ(graph.NumLinks(), 1u);
  EXPECT_EQ(RowOf(graph, 0), (std::vector<NeighborLink>{{2, 2, 1}}));
  EXPECT_EQ(RowOf(graph, 1), std::vector<NeighborLink>{});
  EXPECT_EQ(RowOf(graph, 2), (std::vector<NeighborLink>{{0, 2, 1}}));
}

TEST(NeighborhoodGraph, TakesTheLargerCountsOfBothEnds) {
  const auto graph = NeighborhoodGraph::FromRows({{{1, 2, 0}}, {{0, 1, 3}}}, 1);
  EXPECT_EQ(graph.NumLinks(), 1u);
  EXPECT_EQ(RowOf(graph, 0), (std::vector<NeighborLink>{{1, 2, 3}}));
}

TEST(NeighborhoodGraph, RefusesRowsThatAreNoGraph) {
  EXPECT_THROW((void)NeighborhoodGraph::FromRows({{{0, 1, 0}}}, 1),
               std::logic_error);
  EXPECT_THROW((void)NeighborhoodGraph::FromRows({{{1, 1, 0}}}, 1),
               std::logic_error);
  EXPECT_THROW((void)NeighborhoodGraph::FromRows({{{-1, 1, 0}}}, 1),
               std::logic_error);
  EXPECT_THROW(
      (void)NeighborhoodGraph::FromRows({{{2, 1, 0}, {1, 1, 0}}, {}, {}}, 1),
      std::logic_error);
}

TEST(NeighborhoodGraph, FilterAsksOncePerLinkWithTheSmallerIndexFirst) {
  const auto graph =
      NeighborhoodGraph::FromRows({{{1, 1, 0}, {2, 2, 0}}, {{2, 3, 0}}, {}}, 1);
  int num_calls = 0;
  const auto heavy = graph.Filter(
      [&](std::size_t i, const NeighborLink& link) {
        ++num_calls;
        EXPECT_LT(i, static_cast<std::size_t>(link.edge_idx));
        return link.num_shared > 1;
      },
      1);
  EXPECT_EQ(num_calls, 3);
  EXPECT_EQ(heavy,
            NeighborhoodGraph::FromRows({{{2, 2, 0}}, {{2, 3, 0}}, {}}, 1));
}

TEST(UnionOf, AddsCountsAndKeepsLinksOfEither) {
  const auto a = NeighborhoodGraph::FromRows({{{1, 2, 0}}, {}, {}}, 1);
  const auto b = NeighborhoodGraph::FromRows({{{1, 0, 3}}, {{2, 0, 1}}, {}}, 1);
  EXPECT_EQ(UnionOf(a, b, 1),
            NeighborhoodGraph::FromRows({{{1, 2, 3}}, {{2, 0, 1}}, {}}, 1));
  EXPECT_EQ(UnionOf(a, b, 1), UnionOf(b, a, 1));
  EXPECT_THROW((void)UnionOf(a, NeighborhoodGraph(), 1), std::logic_error);
}

TEST(Contract, AddsLinksBetweenGroupsAndForgetsThoseWithin) {
  // 0 - 1, 0 - 2, 1 - 2, 2 - 3 with the groups {0, 1}, {2, 3}.
  const auto graph = NeighborhoodGraph::FromRows(
      {{{1, 9, 0}, {2, 1, 0}}, {{2, 2, 1}}, {{3, 9, 0}}, {}}, 1);
  EXPECT_EQ(Contract(graph, {0, 0, 1, 1}, 2, 1),
            NeighborhoodGraph::FromRows({{{1, 3, 1}}, {}}, 1));
  EXPECT_THROW((void)Contract(graph, {0, 0, 1, 2}, 2, 1), std::logic_error);
}

}  // namespace
}  // namespace curvix
