// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/link_edges.h"

#include <gtest/gtest.h>
#include <map>
#include <stdexcept>
#include <utility>

#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

using Links = std::map<std::pair<int, int>, int>;

Edge3d EdgeAt(double x, double y, std::vector<EdgeRef> support) {
  return {{x, y, 0}, Eigen::Vector3d::UnitX(), std::move(support)};
}

// Weights by pair of edges, the smaller first.
Links WeightsOf(const NeighborhoodGraph& graph) {
  Links links;
  for (std::size_t i = 0; i < graph.NumEdges(); ++i) {
    for (const NeighborLink& link : graph.Neighbors(i)) {
      if (link.edge_idx > static_cast<int>(i)) {
        links[{static_cast<int>(i), link.edge_idx}] = link.Weight();
      }
    }
  }
  return links;
}

TEST(BuildGraph, WeighsLinksByTheNumberOfSharedEdges) {
  const std::vector<Edge3d> edges = {EdgeAt(0, 0, {{0, 1}, {1, 1}, {2, 1}}),
                                     EdgeAt(1, 0, {{0, 1}, {1, 1}, {2, 7}}),
                                     EdgeAt(2, 0, {{2, 7}}),
                                     EdgeAt(3, 0, {{0, 7}, {3, 1}}),
                                     EdgeAt(4, 0, {})};
  EXPECT_EQ(WeightsOf(BuildGraph(edges, {}, 1)),
            (Links{{{0, 1}, 2}, {{1, 2}, 1}}));
}

TEST(BuildGraph, LinksNothingWithoutEdges) {
  EXPECT_EQ(BuildGraph({}, {}, 2).NumEdges(), 0u);
  EXPECT_EQ(BuildGraph({EdgeAt(0, 0, {{0, 1}})}, {}, 2).NumLinks(), 0u);
}

TEST(BuildGraph, AsksForTheHeaviestThenTheNearestLinks) {
  NeighborhoodOptions options;
  options.max_num_links = 1;
  // 0 shares one edge with 1, 2, 3 and two with 3; 1 is nearer to 2 than to 0.
  const std::vector<Edge3d> edges = {EdgeAt(0, 0, {{0, 1}, {1, 1}}),
                                     EdgeAt(5, 0, {{0, 1}}),
                                     EdgeAt(6, 0, {{0, 1}}),
                                     EdgeAt(9, 0, {{0, 1}, {1, 1}})};
  EXPECT_EQ(WeightsOf(BuildGraph(edges, options, 1)),
            (Links{{{0, 3}, 2}, {{1, 2}, 1}}));
}

TEST(BuildGraph, StaysSmallWhenManyEdgesLeanOnOne) {
  NeighborhoodOptions options;
  options.max_num_links = 10;
  std::vector<Edge3d> edges;
  for (int i = 0; i < 1000; ++i) edges.push_back(EdgeAt(i, 0, {{0, 0}}));
  const NeighborhoodGraph graph = BuildGraph(edges, options, 2);
  EXPECT_LE(graph.NumLinks(), 10u * 1000u);
  EXPECT_GE(graph.NumLinks(), 10u * 1000u / 2);
}

TEST(LinkTangents, LiftsNeighborsInTheImageToSpace) {
  EdgeMap map;
  map.edges.resize(4);
  map.neighbors.resize(4);
  map.neighbors[0].next = 1;  // not mutual: 1 knows nothing of 0
  map.neighbors[2].previous = 1;
  map.neighbors[1].next = 2;
  const std::vector<Edge3d> edges = {EdgeAt(0, 0, {{0, 0}, {1, 0}}),
                                     EdgeAt(1, 0, {{0, 1}, {1, 1}}),
                                     EdgeAt(2, 0, {{0, 2}}),
                                     EdgeAt(3, 0, {{0, 3}})};
  EXPECT_EQ(WeightsOf(LinkTangents(edges, {map, map}, {}, 1)),
            (Links{{{0, 1}, 2}, {{1, 2}, 1}}));
}

TEST(LinkTangents, RefusesSupportThatIsNotThere) {
  const std::vector<Edge3d> edges = {EdgeAt(0, 0, {{0, 5}})};
  EXPECT_THROW((void)LinkTangents(edges, {EdgeMap()}, {}, 1), std::logic_error);
  EXPECT_THROW((void)LinkTangents(edges, {}, {}, 1), std::logic_error);
}

TEST(SpreadLimits, AreMeanPlusLambdaSigmaOfEachDistance) {
  // Normal distances 1 and 3, tangential 0 and 4, no angles.
  const std::vector<Edge3d> edges = {
      EdgeAt(0, 0, {}), EdgeAt(0, 1, {}), EdgeAt(4, 4, {})};
  const auto graph = NeighborhoodGraph::FromRows({{{1}}, {{2}}, {}}, 1);
  const EdgeDistances limits = SpreadLimits(edges, graph, 2, 1);
  EXPECT_DOUBLE_EQ(limits.normal, 2 + 2 * 1);
  EXPECT_DOUBLE_EQ(limits.tangential, 2 + 2 * 2);
  EXPECT_DOUBLE_EQ(limits.angle, 0);
}

// Ten short links and one odd one of the given weight, from 0 to 11.
std::pair<std::vector<Edge3d>, NeighborhoodGraph> OneOddLink(
    const Edge3d& odd, std::int32_t weight) {
  std::vector<Edge3d> edges;
  std::vector<std::vector<NeighborLink>> rows(12);
  for (int i = 0; i < 11; ++i) {
    edges.push_back(EdgeAt(0.1 * i, 0.01 * (i % 2), {}));
    if (i < 10) rows[static_cast<std::size_t>(i)].push_back({i + 1, 1, 0});
  }
  edges.push_back(odd);
  rows[0].push_back({11, weight, 0});
  return {edges, NeighborhoodGraph::FromRows(rows, 1)};
}

TEST(PruneBySpread, RemovesALightLinkThatIsFarOffInAnyWay) {
  const Edge3d across = EdgeAt(0.1, 1, {});
  const Edge3d along = EdgeAt(1, 0, {});
  Edge3d turned = EdgeAt(0.1, 0, {});
  turned.tangent = Eigen::Vector3d::UnitZ();
  for (const Edge3d& odd : {across, along, turned}) {
    const auto [edges, graph] = OneOddLink(odd, 1);
    EXPECT_EQ(PruneBySpread(edges, graph, {}, 1).Neighbors(11).size(), 0u);
    EXPECT_GE(PruneBySpread(edges, graph, {}, 1).NumLinks(), 9u);
    const auto [same_edges, heavy] = OneOddLink(odd, 2);
    EXPECT_EQ(PruneBySpread(same_edges, heavy, {}, 1).Neighbors(11).size(), 1u);
  }
}

TEST(PruneBySpread, DoesNotMindOppositeTangents) {
  Edge3d flipped = EdgeAt(0.1, 0, {});
  flipped.tangent = -flipped.tangent;
  const auto [edges, graph] = OneOddLink(flipped, 1);
  EXPECT_EQ(PruneBySpread(edges, graph, {}, 1).Neighbors(11).size(), 1u);
}

TEST(PruneByProjection, AsksOnlyTheViewsThatSeeBoth) {
  const std::vector<PosedView> views = RingOfViews(4);
  NeighborhoodOptions options;
  options.max_projection_distance_px = 6;
  // Ten pixels apart for view 0, hardly for view 1, which looks along.
  const Eigen::Vector3d line_of_sight = views[1].center.normalized();
  Edge3d a = EdgeAt(0, 0, {{1, 0}});
  Edge3d b = a;
  b.position = 0.08 * line_of_sight;
  const auto graph = NeighborhoodGraph::FromRows({{{1, 1, 0}}, {}}, 1);
  const auto num_left = [&] {
    return PruneByProjection({a, b}, graph, views, options, 1).NumLinks();
  };
  EXPECT_EQ(num_left(), 1u);
  a.support = {{0, 0}, {1, 0}};
  EXPECT_EQ(num_left(), 1u);
  b.support = {{0, 0}, {1, 0}};
  EXPECT_EQ(num_left(), 0u);
  b.support = {{1, 0}};
  b.position = 2 * views[1].center;  // behind the camera
  EXPECT_EQ(num_left(), 0u);
}

SyntheticEdges NoisyCube() {
  SyntheticEdgeOptions options;
  options.num_tracks = 3;
  options.spacing = 0.03;
  options.lateral_sigma = 0.002;
  options.tangent_sigma = 0.05;
  return MakeSyntheticEdges(CubeCurves(), options);
}

TEST(LinkEdges, NeverLinksCurvesThatShareNoEdges) {
  const SyntheticEdges made = NoisyCube();
  const NeighborhoodGraph graph =
      LinkEdges(made.edges, made.edge_maps, made.views, {}, 2);
  ASSERT_GT(graph.NumLinks(), made.edges.size() / 2);
  for (std::size_t i = 0; i < graph.NumEdges(); ++i) {
    for (const NeighborLink& link : graph.Neighbors(i)) {
      EXPECT_EQ(made.curve_of[i],
                made.curve_of[static_cast<std::size_t>(link.edge_idx)]);
    }
  }
}

TEST(LinkEdges, DoesNotDependOnTheNumberOfThreads) {
  const SyntheticEdges made = NoisyCube();
  const auto with = [&](int num_threads) {
    return LinkEdges(made.edges, made.edge_maps, made.views, {}, num_threads);
  };
  const NeighborhoodGraph graph = with(1);
  EXPECT_EQ(with(2), graph);
  EXPECT_EQ(with(5), graph);
}

TEST(LinkEdges, FindsTheSameLinksForReversedEdges) {
  const SyntheticEdges made = NoisyCube();
  const std::vector<Edge3d> reversed(made.edges.rbegin(), made.edges.rend());
  const auto links =
      WeightsOf(LinkEdges(made.edges, made.edge_maps, made.views, {}, 2));
  Links mirrored;
  const int last = static_cast<int>(made.edges.size()) - 1;
  for (const auto& [pair, weight] :
       WeightsOf(LinkEdges(reversed, made.edge_maps, made.views, {}, 2))) {
    mirrored[{last - pair.second, last - pair.first}] = weight;
  }
  EXPECT_EQ(mirrored, links);
}

}  // namespace
}  // namespace curvix
