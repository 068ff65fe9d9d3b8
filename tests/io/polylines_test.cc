// SPDX-License-Identifier: BSD-3-Clause
#include "io/polylines.h"

#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace curvix {
namespace {

// Vertices 0, 1, 2, ... on the x axis, so that a curve names its vertices.
LineGraph OnAxis(int num_vertices,
                 std::vector<std::array<std::int64_t, 2>> edges) {
  LineGraph graph;
  for (int i = 0; i < num_vertices; ++i) graph.positions.emplace_back(i, 0, 0);
  graph.edges = std::move(edges);
  return graph;
}

std::vector<int> Names(const Curve& curve) {
  std::vector<int> names;
  for (const CurveSample& sample : curve.samples) {
    names.push_back(static_cast<int>(sample.position.x()));
  }
  return names;
}

using Ints = std::vector<int>;

TEST(JoinPolylines, FollowsShuffledAndReversedEdges) {
  const auto curves = JoinPolylines(OnAxis(5, {{4, 1}, {0, 2}, {2, 4}}));
  ASSERT_EQ(curves->curves.size(), 1u);
  EXPECT_EQ(Names(curves->curves[0]), (Ints{0, 2, 4, 1}));
  EXPECT_FALSE(curves->curves[0].closed);
}

TEST(JoinPolylines, CycleIsClosedAndStartsWhereItsFirstEdgeStarts) {
  const auto curves = JoinPolylines(OnAxis(3, {{1, 2}, {2, 0}, {0, 1}}));
  ASSERT_EQ(curves->curves.size(), 1u);
  EXPECT_TRUE(curves->curves[0].closed);
  EXPECT_EQ(Names(curves->curves[0]), (Ints{1, 2, 0}));
}

TEST(JoinPolylines, SplitsAtJunctions) {
  // A letter Y: three branches at vertex 2.
  const auto curves =
      JoinPolylines(OnAxis(5, {{0, 1}, {1, 2}, {2, 3}, {2, 4}}));
  ASSERT_EQ(curves->curves.size(), 3u);
  EXPECT_EQ(Names(curves->curves[0]), (Ints{0, 1, 2}));
  EXPECT_EQ(Names(curves->curves[1]), (Ints{2, 3}));
  EXPECT_EQ(Names(curves->curves[2]), (Ints{2, 4}));
}

TEST(JoinPolylines, LoopAtAJunctionIsClosed) {
  const auto curves =
      JoinPolylines(OnAxis(4, {{0, 1}, {1, 2}, {2, 3}, {3, 1}}));
  ASSERT_EQ(curves->curves.size(), 2u);
  EXPECT_EQ(Names(curves->curves[0]), (Ints{0, 1}));
  EXPECT_TRUE(curves->curves[1].closed);
  EXPECT_EQ(Names(curves->curves[1]), (Ints{1, 2, 3}));
}

TEST(JoinPolylines, DropsRepeatedEdgesLoopsAndLoneVertices) {
  const auto curves =
      JoinPolylines(OnAxis(4, {{0, 0}, {1, 2}, {2, 1}, {1, 2}}));
  ASSERT_EQ(curves->curves.size(), 1u);
  EXPECT_EQ(Names(curves->curves[0]), (Ints{1, 2}));
}

TEST(JoinPolylines, TangentsComeFromTheGraphElseFromNeighbours) {
  LineGraph graph = OnAxis(3, {{0, 1}, {1, 2}});
  graph.tangents = {{0, 2, 0}, {0, 0, 0}, {0, 0, -1}};
  const auto curves = JoinPolylines(graph);
  const Curve& curve = curves->curves[0];
  EXPECT_EQ(curve.samples[0].tangent, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(curve.samples[1].tangent, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(curve.samples[2].tangent, Eigen::Vector3d(0, 0, -1));
}

TEST(JoinPolylines, TangentsPointAlongTheCurve) {
  LineGraph graph = OnAxis(3, {{0, 1}, {1, 2}});
  graph.tangents.assign(3, -Eigen::Vector3d::UnitX());
  const auto curves = JoinPolylines(graph);
  ASSERT_EQ(curves->curves.size(), 1u);
  EXPECT_EQ(Names(curves->curves[0]), (Ints{0, 1, 2}));
  for (const CurveSample& sample : curves->curves[0].samples) {
    EXPECT_EQ(sample.tangent, Eigen::Vector3d::UnitX());
  }
}

TEST(JoinPolylines, ReportsEdgesOutOfRangeAndPositionsThatAreNotFinite) {
  const Status status = JoinPolylines(OnAxis(2, {{0, 2}})).status();
  EXPECT_EQ(status.code(), StatusCode::kDataLoss);
  EXPECT_EQ(status.message(),
            "edge 0 names vertex 2, counted from 0, but there are 2; the file "
            "is damaged");
  EXPECT_EQ(JoinPolylines(OnAxis(2, {{-1, 1}})).status().code(),
            StatusCode::kDataLoss);
  LineGraph graph = OnAxis(2, {{0, 1}});
  graph.positions[1].z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(JoinPolylines(graph).status().code(), StatusCode::kDataLoss);
}

}  // namespace
}  // namespace curvix
