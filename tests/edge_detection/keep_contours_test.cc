// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/detect_view_edges.h"

#include <gtest/gtest.h>

#include <vector>

namespace curvix {
namespace {

// A chain of mutual neighbours, `length` edges of strength `strength`.
void AppendChain(int length,
                 float strength,
                 std::vector<Edge2d>& edges,
                 std::vector<EdgeNeighbors>& neighbors) {
  const auto begin = static_cast<std::int32_t>(edges.size());
  for (std::int32_t i = 0; i < length; ++i) {
    Edge2d edge;
    edge.position.x() = begin + i;
    edge.strength = strength;
    edges.push_back(edge);
    neighbors.emplace_back();
    if (i > 0) neighbors.back().previous = begin + i - 1;
    if (i + 1 < length) neighbors.back().next = begin + i + 1;
  }
}

struct Chain {
  int length;
  float strength;
};

class KeepContoursTest : public ::testing::Test {
 protected:
  void Build(const std::vector<Chain>& chains) {
    for (const Chain& chain : chains) {
      AppendChain(chain.length, chain.strength, edges_, neighbors_);
    }
  }
  KeptEdges Keep(std::int64_t max_edges,
                 std::int64_t max_unthinned_edges = 0,
                 double thinned_spacing_px = 0) const {
    EdgeDetectionOptions options;
    options.min_contour_edges = 4;
    ContourLimits limits;
    limits.min_gradient = 10;
    limits.max_edges = max_edges;
    limits.max_unthinned_edges = max_unthinned_edges;
    limits.thinned_spacing_px = thinned_spacing_px;
    return KeepContours(edges_, neighbors_, options, limits);
  }

  std::vector<Edge2d> edges_;
  std::vector<EdgeNeighbors> neighbors_;
};

TEST(DropLeastProminent, KeepsTheOrderAndWhatIsAsProminentAsTheLast) {
  std::vector<LocatedEdge> edges;
  for (const float strength : {3.0f, 1.0f, 4.0f, 2.0f, 3.0f, 5.0f}) {
    const double x = 100.0 * static_cast<double>(edges.size());
    edges.push_back({{x, 0}, {0, strength}});
  }
  std::vector<LocatedEdge> all = edges;
  EXPECT_EQ(DropLeastProminent(6, &all), 0);
  EXPECT_EQ(all.size(), 6u);
  EXPECT_EQ(DropLeastProminent(3, &edges), 2)
      << "two of the four are equally prominent";
  ASSERT_EQ(edges.size(), 4u);
  EXPECT_EQ(edges[0].strength(), 3);
  EXPECT_EQ(edges[1].strength(), 4);
  EXPECT_EQ(edges[2].strength(), 3);
  EXPECT_EQ(edges[3].strength(), 5);
}

TEST(DropLeastProminent, DropsCrowdedEdgesBeforeWeakerOnes) {
  std::vector<LocatedEdge> edges = {{{0, 0}, {0, 4}, 0.5f},
                                    {{100, 0}, {0, 2}, 0}};
  EXPECT_EQ(DropLeastProminent(1, &edges), 1);
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_EQ(edges[0].strength(), 2);
}

std::vector<float> Strengths(const KeptEdges& kept) {
  std::vector<float> strengths;
  for (const Edge2d& edge : kept.edges) {
    if (strengths.empty() || strengths.back() != edge.strength) {
      strengths.push_back(edge.strength);
    }
  }
  return strengths;
}

TEST_F(KeepContoursTest, DropsWhatIsBothShortAndWeak) {
  Build({{3, 19}, {4, 11}, {3, 20}, {1, 15}});
  const KeptEdges kept = Keep(100);
  EXPECT_EQ(Strengths(kept), (std::vector<float>{11, 20}));
  EXPECT_EQ(kept.num_isolated, 4);
  EXPECT_EQ(kept.num_over_limit, 0);
}

TEST_F(KeepContoursTest, KeepsTheStrongestLongContoursWithinTheLimit) {
  Build({{5, 12}, {3, 90}, {6, 30}, {5, 25}, {2, 15}});
  EXPECT_EQ(Strengths(Keep(19)), (std::vector<float>{12, 90, 30, 25}));
  EXPECT_EQ(Strengths(Keep(18)), (std::vector<float>{12, 30, 25}))
      << "short contours go first";
  EXPECT_EQ(Strengths(Keep(15)), (std::vector<float>{30, 25}));
  EXPECT_EQ(Strengths(Keep(6)), (std::vector<float>{30}));
  EXPECT_TRUE(Keep(5).edges.empty()) << "contours are kept whole";
  EXPECT_EQ(Keep(15).num_over_limit, 8);
  EXPECT_EQ(Keep(15).num_isolated, 2);
}

TEST_F(KeepContoursTest, KeepsTheFirstOfEquals) {
  Build({{4, 30}, {4, 30}});
  const KeptEdges kept = Keep(4);
  ASSERT_EQ(kept.edges.size(), 4u);
  EXPECT_EQ(kept.edges[0].position.x(), 0);
}

TEST_F(KeepContoursTest, KeepsStraightContoursBeforeBentOnesAsStrong) {
  Build({{12, 30}, {12, 31}});
  // The second contour turns by 20 degrees from edge to edge.
  for (std::size_t i = 12; i < 24; ++i) {
    edges_[i].angle = 0.35f * static_cast<float>(i);
  }
  EXPECT_EQ(Strengths(Keep(12)), (std::vector<float>{30}));
}

TEST_F(KeepContoursTest, KeepsLongWeakLinesBeforeShortSteepOnes) {
  Build({{5, 30}, {100, 12}, {5, 30}});
  EXPECT_EQ(Strengths(Keep(105)), (std::vector<float>{30, 12}));
  EXPECT_EQ(Strengths(Keep(100)), (std::vector<float>{12}));
}

TEST_F(KeepContoursTest, KeepsBordersBeforeTextureSomewhatStronger) {
  Build({{40, 25}, {40, 30}, {40, 30}, {40, 30}});
  // The first line stands alone; the others are the middle of three, and two
  // that have an empty side.
  const std::vector<double> ys = {100, 20, 12, 28};
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    edges_[i].position = {static_cast<double>(i % 40), ys[i / 40]};
  }
  const KeptEdges kept = Keep(120);
  ASSERT_EQ(kept.edges.size(), 120u);
  for (const Edge2d& edge : kept.edges) EXPECT_NE(edge.position.y(), 20);
}

TEST_F(KeepContoursTest, LeavesNoLargerGapsThanItMust) {
  Build({{3, 15}, {10, 30}, {2, 40}});
  for (Edge2d& edge : edges_) edge.position *= 0.5;
  const KeptEdges kept = Keep(100, 11, 1);
  ASSERT_EQ(kept.edges.size(), 6u);
  EXPECT_EQ(kept.num_thinned_out, 6);
  EXPECT_EQ(kept.num_isolated, 3);
  EXPECT_EQ(kept.num_over_limit, 0);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(kept.edges[i].position.x(), 1.5 + static_cast<double>(i));
  }
  EXPECT_EQ(kept.edges[5].strength, 40) << "every contour is still there";
  EXPECT_EQ(Keep(100, 11, 0.5).num_thinned_out, 0);
  EXPECT_EQ(Keep(100, 12, 1).num_thinned_out, 0) << "these are few enough";
}

TEST_F(KeepContoursTest, ThinsClosedContours) {
  Build({{8, 30}});
  neighbors_.front().previous = 7;
  neighbors_.back().next = 0;
  EXPECT_EQ(Keep(100, 0, 2).edges.size(), 4u);
}

TEST_F(KeepContoursTest, KeepsTheOrderAndAcceptsNoEdges) {
  EXPECT_TRUE(Keep(10).edges.empty());
  Build({{5, 20}, {5, 60}, {5, 40}});
  const KeptEdges kept = Keep(100);
  ASSERT_EQ(kept.edges.size(), 15u);
  for (std::size_t i = 0; i < kept.edges.size(); ++i) {
    EXPECT_EQ(kept.edges[i].position.x(), static_cast<double>(i));
  }
}

}  // namespace
}  // namespace curvix
