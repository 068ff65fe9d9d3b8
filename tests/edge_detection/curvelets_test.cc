// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/curvelets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/angles.h"
#include "tests/edge_detection/oriented_edges.h"
#include "tests/edge_detection/rendered_images.h"

namespace curvix {
namespace {

Edge2d EdgeAt(double x, double y, double degrees) {
  Edge2d edge;
  edge.position = {x, y};
  edge.angle = static_cast<float>(DegToRad(degrees));
  return edge;
}

std::vector<EdgeNeighbors> Link(const std::vector<Edge2d>& edges) {
  return LinkNeighbors(edges, EdgeDetectionOptions());
}

TEST(LinkNeighbors, RunsAlongACircleAllTheWayRoundAndBack) {
  const std::vector<Edge2d> edges =
      OrientedEdges(RenderDisc(128, {64.3, 63.8}, 45), {}, 1);
  const std::vector<EdgeNeighbors> links = Link(edges);
  ASSERT_GT(edges.size(), 500u);
  ASSERT_EQ(links.size(), edges.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    ASSERT_TRUE(links[i].next && links[i].previous) << i;
    const auto next = static_cast<std::size_t>(*links[i].next);
    EXPECT_EQ(links[next].previous, static_cast<std::int32_t>(i));
  }
  std::size_t steps = 0, at = 0;
  do {
    at = static_cast<std::size_t>(*links[at].next);
    ++steps;
  } while (at != 0 && steps <= edges.size());
  EXPECT_EQ(steps, edges.size());
}

TEST(LinkNeighbors, TakesTheNearestOnEachSide) {
  const auto links = Link({EdgeAt(0, 0, 0),
                           EdgeAt(2, 0, 0),
                           EdgeAt(0.9, 0.05, 3),
                           EdgeAt(-0.8, 0, -4)});
  EXPECT_EQ(links[0].next, 2);
  EXPECT_EQ(links[0].previous, 3);
  EXPECT_EQ(links[1].next, std::nullopt);
  EXPECT_EQ(links[1].previous, 2);
}

TEST(LinkNeighbors, BreaksTiesByIndex) {
  const auto links =
      Link({EdgeAt(1, 0.125, 0), EdgeAt(0, 0, 0), EdgeAt(1, -0.125, 0)});
  EXPECT_EQ(links[1].next, 0);
}

TEST(LinkNeighbors, RefusesWhatDoesNotContinueTheEdge) {
  const Edge2d edge = EdgeAt(10, 10, 30);
  const Eigen::Vector2d tangent(std::cos(DegToRad(30)), 0.5);
  const Eigen::Vector2d ahead = edge.position + tangent;
  const Eigen::Vector2d far = edge.position + 3.1 * tangent;
  EXPECT_TRUE(Link({edge, EdgeAt(ahead.x(), ahead.y(), 44)})[0].next);
  EXPECT_FALSE(Link({edge, EdgeAt(ahead.x(), ahead.y(), 46)})[0].next)
      << "turns too much";
  EXPECT_FALSE(Link({edge, EdgeAt(ahead.x(), ahead.y(), 210)})[0].next)
      << "bright on the other side";
  EXPECT_FALSE(Link({edge, EdgeAt(far.x(), far.y(), 30)})[0].next) << "too far";
  EXPECT_FALSE(Link({edge, EdgeAt(10, 11, 30)})[0].next) << "runs beside it";
  EXPECT_FALSE(Link({edge, EdgeAt(10, 10, 30)})[0].next) << "the same place";
}

TEST(LinkNeighbors, AcceptsNoEdges) { EXPECT_TRUE(Link({}).empty()); }

}  // namespace
}  // namespace curvix
