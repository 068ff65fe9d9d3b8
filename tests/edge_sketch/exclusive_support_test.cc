// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/exclusive_support.h"

#include <gtest/gtest.h>
#include <vector>

#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

// Edges along a line, each supported in all of eight views.
class ExclusiveSupportTest : public ::testing::Test {
 protected:
  ExclusiveSupportTest() {
    SyntheticEdgeOptions options;
    options.num_views = 8;
    options.support_share = 1;
    edges_ = MakeSyntheticEdges({LineCurve({-1, 0, 0}, {1, 0.5, 0})}, options);
    for (Edge3d& edge : edges_.edges) {
      edge.evidence = 30;
      edge.sigma = 1e-3;
    }
  }

  // A weaker edge that takes supports from an edge of the line, at `place`.
  Edge3d Rival(const Eigen::Vector3d& place, std::size_t num_supports) const {
    Edge3d rival = Middle();
    rival.position = place;
    rival.evidence = 15;
    rival.support.resize(num_supports);
    return rival;
  }

  const Edge3d& Middle() const { return edges_.edges[edges_.edges.size() / 2]; }

  std::size_t NumLeftWith(const Edge3d& rival,
                          int min_num_exclusive_views) const {
    std::vector<Edge3d> edges = edges_.edges;
    edges.insert(edges.begin(), rival);
    return DropWithoutExclusiveSupport(
               edges, edges_.views, edges_.edge_maps, min_num_exclusive_views)
        .size();
  }

  SyntheticEdges edges_;
};

TEST_F(ExclusiveSupportTest, LeavesOutWhatOnlyEdgesOfOthersSupport) {
  const std::size_t num_edges = edges_.edges.size();
  const Eigen::Vector3d elsewhere =
      Middle().position + Eigen::Vector3d(0, 0, 1);
  EXPECT_EQ(NumLeftWith(Rival(elsewhere, 8), 3), num_edges);
  EXPECT_EQ(NumLeftWith(Rival(elsewhere, 8), 1), num_edges);
  EXPECT_EQ(NumLeftWith(Rival(elsewhere, 8), 0), num_edges + 1);
}

TEST_F(ExclusiveSupportTest, KeepsSeveralEdgesAtOnePlace) {
  const Eigen::Vector3d near = Middle().position + Eigen::Vector3d(0, 0, 2e-3);
  EXPECT_EQ(NumLeftWith(Rival(near, 8), 3), edges_.edges.size() + 1);
}

// 0.1 is more than ten pixels.
TEST_F(ExclusiveSupportTest, CountsTheEdgesOfItsOwn) {
  const Eigen::Vector3d elsewhere =
      Middle().position + Eigen::Vector3d(0, 0, 0.1);
  for (std::size_t num_own = 0; num_own < 5; ++num_own) {
    Edge3d rival = Rival(elsewhere, 8);
    SyntheticEdges edges = edges_;
    for (std::size_t i = 0; i < num_own; ++i) {
      EdgeMap& map = edges.edge_maps[i];
      rival.support[i].edge_idx = static_cast<std::int32_t>(map.edges.size());
      map.edges.emplace_back();
      map.neighbors.emplace_back();
    }
    edges.edges.push_back(rival);
    const std::vector<Edge3d> left = DropWithoutExclusiveSupport(
        edges.edges, edges.views, edges.edge_maps, 3);
    EXPECT_EQ(left.size(), edges_.edges.size() + (num_own >= 3 ? 1 : 0));
  }
}

TEST_F(ExclusiveSupportTest, TheStrongerOneKeepsTheEdges) {
  Edge3d rival = Rival(Middle().position + Eigen::Vector3d(0, 0, 1), 8);
  rival.evidence = 100;
  std::vector<Edge3d> edges = edges_.edges;
  edges.push_back(rival);
  const std::vector<Edge3d> left =
      DropWithoutExclusiveSupport(edges, edges_.views, edges_.edge_maps, 3);
  ASSERT_LT(left.size(), edges.size());
  EXPECT_EQ(left.back().position, rival.position);
  for (const Edge3d& edge : left) {
    EXPECT_NE(edge.position, Middle().position);
  }
}

// What is left out claims nothing: without it, the same is left.
TEST_F(ExclusiveSupportTest, LeavesTheSameTheSecondTime) {
  std::vector<Edge3d> edges = edges_.edges;
  for (const double z : {0.5, 1.0, -0.5}) {
    edges.push_back(Rival(Middle().position + Eigen::Vector3d(0, 0, z), 8));
  }
  const std::vector<Edge3d> once =
      DropWithoutExclusiveSupport(edges, edges_.views, edges_.edge_maps, 3);
  EXPECT_EQ(once.size(), edges_.edges.size());
  EXPECT_EQ(DropWithoutExclusiveSupport(once, edges_.views, edges_.edge_maps, 3)
                .size(),
            once.size());
}

TEST(DropWithoutExclusiveSupport, HasNothingToDoWithNothing) {
  EXPECT_TRUE(DropWithoutExclusiveSupport({}, {}, {}, 3).empty());
}

}  // namespace
}  // namespace curvix
