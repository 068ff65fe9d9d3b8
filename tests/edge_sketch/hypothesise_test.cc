// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/hypothesise.h"

#include <curvix/options.h>
#include <gtest/gtest.h>
#include <vector>

#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

// Two views, the second turned upside down about its axis.
std::vector<PosedView> TwoViewsOneRolled() {
  std::vector<PosedView> views = RingOfViews(16);
  views.resize(2);
  const Eigen::Matrix3d roll = Eigen::Vector3d(-1, -1, 1).asDiagonal();
  views[1].rotation = roll * views[1].rotation;
  views[1].translation = roll * views[1].translation;
  return views;
}

// A line that is bright on one side.
class LineInTwoViews {
 public:
  explicit LineInTwoViews(std::size_t h1 = 0) : h1_(h1), h2_(1 - h1) {
    MakeSharp(maps_);
  }

  std::vector<Edge2d>& edges1() { return maps_[h1_].edges; }
  std::vector<Edge2d>& edges2() { return maps_[h2_].edges; }

  // Of the edge in the middle of the line in H1.
  std::size_t NumHypotheses(bool compares_appearance) const {
    const AppearanceDensity appearance2(maps_[h2_].edges);
    const auto pencil = EpipolarPencil::Make(views_[h1_], views_[h2_]);
    const HypothesisViews pair(*pencil,
                               views_[h1_],
                               views_[h2_],
                               maps_[h2_].edges,
                               DepthRange(),
                               options_,
                               compares_appearance ? &appearance2 : nullptr);
    const std::vector<Edge2d>& edges = maps_[h1_].edges;
    return pair.Hypothesise(edges[edges.size() / 2]).hypotheses.size();
  }

 private:
  std::size_t h1_, h2_;
  Options options_;
  std::vector<PosedView> views_ = TwoViewsOneRolled();
  std::vector<EdgeMap> maps_ =
      ExactEdgeMaps({LineCurve({-1, -1, -0.5}, {1, 0.5, 1})}, views_, 1);
};

TEST(Hypothesise, PairsEdgesThatLookAlike) {
  for (const std::size_t h1 : {0u, 1u}) {
    LineInTwoViews views(h1);
    EXPECT_EQ(views.NumHypotheses(false), 1u);
    EXPECT_EQ(views.NumHypotheses(true), 1u);
    SwapSides(views.edges1());
    SwapSides(views.edges2());
    EXPECT_EQ(views.NumHypotheses(true), 1u);
  }
}

TEST(Hypothesise, DoesNotPairEdgesThatAreBrightOnOtherSides) {
  for (const std::size_t h1 : {0u, 1u}) {
    LineInTwoViews views(h1);
    SwapSides(views.edges2());
    EXPECT_EQ(views.NumHypotheses(false), 1u);
    EXPECT_EQ(views.NumHypotheses(true), 0u);
  }
}

TEST(Hypothesise, PairsEdgesAlikeHoweverSoft) {
  LineInTwoViews views;
  for (auto* edges : {&views.edges1(), &views.edges2()}) {
    for (Edge2d& edge : *edges) edge.sharpness = 0.001f;
  }
  EXPECT_EQ(views.NumHypotheses(true), 1u);
}

TEST(Hypothesise, PairsEdgesOfUnknownSharpness) {
  LineInTwoViews views;
  SwapSides(views.edges2());
  for (Edge2d& edge : views.edges2()) edge.sharpness = 0;
  EXPECT_EQ(views.NumHypotheses(true), 1u);
}

}  // namespace
}  // namespace curvix
