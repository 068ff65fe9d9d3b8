// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/connect_edges.h"

#include <gtest/gtest.h>
#include <cstdint>
#include <vector>

#include "curve_drawing/thin_edges.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

Edge3d EdgeAtPx(double x, double y, double sign = 1) {
  return {{x * kPx, y * kPx, 0}, sign * Eigen::Vector3d::UnitX(), {}};
}

// All linked with all.
NeighborhoodGraph Complete(std::size_t num_edges) {
  std::vector<std::vector<NeighborLink>> rows(num_edges);
  for (std::size_t i = 0; i < num_edges; ++i) {
    for (std::size_t j = i + 1; j < num_edges; ++j) {
      rows[i].push_back({static_cast<std::int32_t>(j), 1, 0});
    }
  }
  return NeighborhoodGraph::FromRows(rows);
}

ConnectivityGraph Connected(const std::vector<Edge3d>& edges) {
  return ConnectEdges(edges, Complete(edges.size()), RingOfViews(8), {}, 2);
}

TEST(ConnectEdges, TakesTheNearestOnEitherSide) {
  const auto graph = Connected(
      {EdgeAtPx(0, 0), EdgeAtPx(2, 0), EdgeAtPx(1, 0), EdgeAtPx(3, 0)});
  Validate(graph);
  EXPECT_EQ(graph.forward[0], 2);
  EXPECT_EQ(graph.forward[2], 1);
  EXPECT_EQ(graph.forward[1], 3);
  EXPECT_FALSE(graph.forward[3].has_value());
  EXPECT_FALSE(graph.backward[0].has_value());
}

TEST(ConnectEdges, FlipsEdgesThatOpposeTheSmallestIndex) {
  const auto graph =
      Connected({EdgeAtPx(1, 0, -1), EdgeAtPx(0, 0), EdgeAtPx(2, 0, -1)});
  Validate(graph);
  EXPECT_EQ(graph.flipped, (std::vector<bool>{false, true, false}));
  EXPECT_EQ(graph.forward[0], 1);
  EXPECT_EQ(graph.backward[0], 2);
}

TEST(ConnectEdges, DoesNotJumpToAParallelTrack) {
  // The next edge of the other track is nearer along the tangent.
  const auto graph = Connected(
      {EdgeAtPx(0, 0), EdgeAtPx(1, 1.4), EdgeAtPx(2, 0), EdgeAtPx(3, 1.4)});
  EXPECT_EQ(graph.forward[0], 2);
  EXPECT_EQ(graph.forward[1], 3);
}

TEST(ConnectEdges, ConnectsOnlyEdgesThatChooseEachOther) {
  // 0 and 1 both see 2 ahead; 2 prefers 1.
  const auto graph =
      Connected({EdgeAtPx(0, 0.6), EdgeAtPx(0.3, 0), EdgeAtPx(1.5, 0)});
  Validate(graph);
  EXPECT_EQ(graph.backward[2], 1);
  EXPECT_NE(graph.forward[0], 2);
}

TEST(ConnectEdges, RespectsStepAngleAndLinks) {
  EXPECT_FALSE(
      Connected({EdgeAtPx(0, 0), EdgeAtPx(6, 0)}).forward[0].has_value());
  Edge3d turned = EdgeAtPx(1, 0);
  turned.tangent = Eigen::Vector3d::UnitY();
  EXPECT_FALSE(Connected({EdgeAtPx(0, 0), turned}).forward[0].has_value());
  const auto unlinked = ConnectEdges({EdgeAtPx(0, 0), EdgeAtPx(1, 0)},
                                     NeighborhoodGraph::FromRows({{}, {}}),
                                     RingOfViews(8),
                                     {},
                                     1);
  EXPECT_FALSE(unlinked.forward[0].has_value());
}

TEST(ConnectEdges, TakesDegenerateInput) {
  EXPECT_EQ(Connected({}).NumEdges(), 0u);
  EXPECT_FALSE(Connected({EdgeAtPx(0, 0)}).forward[0].has_value());
  const auto heap = Connected(std::vector<Edge3d>(5, EdgeAtPx(0, 0)));
  Validate(heap);
  for (const auto& next : heap.forward) EXPECT_FALSE(next.has_value());
}

TEST(ThinEdges, MakesOneOfLinkedEdgesInOnePlace) {
  std::vector<Edge3d> edges = {EdgeAtPx(0, 0),
                               EdgeAtPx(0, 0.6, -1),
                               EdgeAtPx(0.1, -0.6),
                               EdgeAtPx(5, 0)};
  edges[0].support = {{0, 3}, {4, 1}};
  edges[1].support = {{0, 4}, {2, 1}};
  edges[2].support = {{2, 9}, {4, 9}};
  const ThinnedEdges thinned =
      ThinEdges(edges, Complete(4), RingOfViews(8), {}, 2);
  ASSERT_EQ(thinned.edges.size(), 2u);
  EXPECT_LT((thinned.edges[0].position - edges[0].position).norm(),
            1e-12);  // the middle one, and the mean across
  EXPECT_EQ(thinned.edges[0].support,
            (std::vector<EdgeRef>{{0, 3}, {2, 1}, {4, 1}}));
  EXPECT_EQ(thinned.edges[1].position, edges[3].position);
  EXPECT_EQ(thinned.graph.NumLinks(), 1u);
}

TEST(ThinEdges, LeavesUnlinkedAndCrossingEdgesAlone) {
  std::vector<Edge3d> edges = {EdgeAtPx(0, 0), EdgeAtPx(0, 0.1)};
  const auto unlinked = NeighborhoodGraph::FromRows({{}, {}});
  EXPECT_EQ(ThinEdges(edges, unlinked, RingOfViews(8), {}, 1).edges.size(), 2u);
  edges[1].tangent = Eigen::Vector3d::UnitY();
  EXPECT_EQ(ThinEdges(edges, Complete(2), RingOfViews(8), {}, 1).edges.size(),
            2u);
}

TEST(ThinEdges, KeepsAllWithoutSpacing) {
  ConnectivityOptions options;
  options.sample_spacing_px = 0;
  const std::vector<Edge3d> edges(3, EdgeAtPx(0, 0));
  const ThinnedEdges thinned =
      ThinEdges(edges, Complete(3), RingOfViews(8), options, 1);
  EXPECT_EQ(thinned.edges.size(), 3u);
  EXPECT_EQ(thinned.graph, Complete(3));
}

}  // namespace
}  // namespace curvix
