// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/group_edges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/model/end_ties.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

using ::testing::ElementsAre;

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
  return NeighborhoodGraph::FromRows(rows, 1);
}

EndTies Connected(const std::vector<Edge3d>& edges) {
  return ConnectEdges(edges, Complete(edges.size()), RingOfViews(8), {}, 2);
}

// The curves that the connected edges are, as lists of edges; "-" before those
// that are flipped.
std::vector<std::string> Traces(const std::vector<Edge3d>& edges) {
  std::vector<std::string> traces;
  for (const EndChain& chain : FollowEnds(Connected(edges))) {
    std::string& trace = traces.emplace_back();
    for (const ChainItem& item : chain.items) {
      trace += (trace.empty() ? "" : " ") +
               std::string(item.flipped ? "-" : "") + std::to_string(item.item);
    }
  }
  return traces;
}

TEST(ConnectEdges, TakesTheNearestOnEitherSide) {
  EXPECT_THAT(
      Traces({EdgeAtPx(0, 0), EdgeAtPx(2, 0), EdgeAtPx(1, 0), EdgeAtPx(3, 0)}),
      ElementsAre("0 2 1 3"));
}

TEST(ConnectEdges, FlipsEdgesThatOpposeTheSmallestIndex) {
  EXPECT_THAT(Traces({EdgeAtPx(1, 0, -1), EdgeAtPx(0, 0), EdgeAtPx(2, 0, -1)}),
              ElementsAre("2 0 -1"));
}

TEST(ConnectEdges, DoesNotJumpToAParallelTrack) {
  // The next edge of the other track is nearer along the tangent.
  EXPECT_THAT(
      Traces(
          {EdgeAtPx(0, 0), EdgeAtPx(1, 1.4), EdgeAtPx(2, 0), EdgeAtPx(3, 1.4)}),
      ElementsAre("0 2", "1 3"));
}

TEST(ConnectEdges, ConnectsOnlyEdgesThatChooseEachOther) {
  // 0 and 1 both see 2 ahead; 2 prefers 1.
  const EndTies ties =
      Connected({EdgeAtPx(0, 0.6), EdgeAtPx(0.3, 0), EdgeAtPx(1.5, 0)});
  EXPECT_EQ(ties[Tail(2)], Head(1));
  EXPECT_NE(ties[Head(0)], Tail(2));
}

TEST(ConnectEdges, RespectsStepAngleAndLinks) {
  EXPECT_FALSE(
      Connected({EdgeAtPx(0, 0), EdgeAtPx(6, 0)})[Head(0)].has_value());
  Edge3d turned = EdgeAtPx(1, 0);
  turned.tangent = Eigen::Vector3d::UnitY();
  EXPECT_FALSE(Connected({EdgeAtPx(0, 0), turned})[Head(0)].has_value());
  const EndTies unlinked =
      ConnectEdges({EdgeAtPx(0, 0), EdgeAtPx(1, 0)},
                   NeighborhoodGraph::FromRows({{}, {}}, 1),
                   RingOfViews(8),
                   {},
                   1);
  EXPECT_FALSE(unlinked[Head(0)].has_value());
}

TEST(ConnectEdges, TakesDegenerateInput) {
  EXPECT_TRUE(Connected({}).empty());
  EXPECT_FALSE(Connected({EdgeAtPx(0, 0)})[Head(0)].has_value());
  for (const auto& tie : Connected(std::vector<Edge3d>(5, EdgeAtPx(0, 0)))) {
    EXPECT_FALSE(tie.has_value());
  }
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
  const auto unlinked = NeighborhoodGraph::FromRows({{}, {}}, 1);
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
