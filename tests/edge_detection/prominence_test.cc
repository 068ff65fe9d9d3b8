// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/detect_view_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace curvix {
namespace {

// Horizontal lines of 60 edges, one a pixel, in rows `ys`.
std::vector<Edge2d> Lines(const std::vector<double>& ys, float strength) {
  std::vector<Edge2d> edges;
  for (const double y : ys) {
    for (int x = 20; x < 80; ++x) {
      Edge2d edge;
      edge.position = {x + 0.5, y};
      edge.strength = strength;
      edges.push_back(edge);
    }
  }
  return edges;
}

float AtMiddle(const std::vector<Edge2d>& edges, std::size_t line) {
  return static_cast<float>(Prominence(edges, 0.5).at(60 * line + 30));
}

TEST(Prominence, CountsTheEmptierSide) {
  EXPECT_FLOAT_EQ(AtMiddle(Lines({50}, 10), 0), 10);
  const std::vector<Edge2d> three = Lines({42, 50, 58}, 10);
  EXPECT_FLOAT_EQ(AtMiddle(three, 0), 10) << "the first line is a border";
  EXPECT_NEAR(AtMiddle(three, 1), 10 / (1 + 9.0 / 81 / 0.1), 1e-5)
      << "nine edges in a square of 81 pixels, each as strong";
  EXPECT_FLOAT_EQ(AtMiddle(three, 2), 10);
}

TEST(Prominence, IsLittleLessAmongWeakerEdges) {
  std::vector<Edge2d> edges = Lines({42, 50, 58}, 10);
  for (std::size_t i = 60; i < 120; ++i) edges[i].strength = 100;
  EXPECT_NEAR(AtMiddle(edges, 1), 100 / (1 + 0.9 / 81 / 0.1), 1e-4);
}

TEST(Prominence, DoesNotDependOnWhichSideIsBright) {
  std::vector<Edge2d> edges = Lines({30, 38, 46, 54}, 10);
  const std::vector<double> before = Prominence(edges, 0.5);
  for (Edge2d& edge : edges) edge.angle += 3.14159265f;
  const std::vector<double> after = Prominence(edges, 0.5);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_NEAR(before[i], after[i], 1e-6);
  }
}

TEST(Prominence, OfLocatedEdgesIsThatOfEdgesAcrossTheirGradients) {
  std::vector<LocatedEdge> located;
  for (int i = 0; i < 400; ++i) {
    const double x = (37 * i) % 101 / 2.0, y = (53 * i) % 89 / 2.0;
    const auto turn = static_cast<float>(i);
    located.push_back(
        {{x, y}, {(5 + turn) * std::cos(turn), (5 + turn) * std::sin(turn)}});
  }
  const std::vector<double> expected =
      Prominence(AcrossGradients(located), 0.5);
  MeasureCrowding(0.5, &located);
  for (std::size_t i = 0; i < located.size(); ++i) {
    EXPECT_NEAR(Prominence(located[i]), expected[i], 1e-5 * expected[i]);
  }
}

TEST(MeasureCrowding, IsTheStrengthOfEdgesOnTheEmptierSide) {
  std::vector<LocatedEdge> located;
  for (const double y : {42.0, 50.0, 58.0}) {
    for (int x = 20; x < 80; ++x) located.push_back({{x + 0.5, y}, {0, 10}});
  }
  MeasureCrowding(0.5, &located);
  EXPECT_EQ(located.at(30).crowding, 0) << "the first line is a border";
  EXPECT_FLOAT_EQ(located.at(90).crowding, 9.0F / 81)
      << "nine edges in a square of 81 pixels, each as strong";
  EXPECT_EQ(located.at(150).crowding, 0);
  const std::vector<Edge2d> edges = AcrossGradients(located);
  EXPECT_EQ(edges.at(90).crowding, Eigen::half(9.0F / 81));
}

// Contours sampled half as often have half as many edges beside them.
TEST(Prominence, DoesNotDependOnTheSampling) {
  const std::vector<Edge2d> often = Lines({42, 50, 58}, 10);
  std::vector<Edge2d> seldom;
  for (std::size_t i = 0; i < often.size(); i += 2) seldom.push_back(often[i]);
  EXPECT_NEAR(Prominence(seldom, 1).at(45), Prominence(often, 0.5).at(90), 0.5);
  EXPECT_LT(Prominence(often, 0.5).at(90), 6);
}

TEST(Prominence, StaysWhenEdgesMoveOutOfTheImage) {
  std::vector<Edge2d> edges = Lines({30, 38, 46, 54}, 10);
  const std::vector<double> before = Prominence(edges, 0.5);
  for (Edge2d& edge : edges) edge.position -= Eigen::Vector2d(50, 41);
  const std::vector<double> after = Prominence(edges, 0.5);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_NEAR(before[i], after[i], 1e-6);
  }
}

TEST(Prominence, AcceptsNoEdgesAndTheBorderOfTheImage) {
  EXPECT_TRUE(Prominence(std::vector<Edge2d>(), 0.5).empty());
  Edge2d corner;
  corner.strength = 1;
  EXPECT_EQ(Prominence(std::vector<Edge2d>{corner}, 0.5),
            std::vector<double>{1});
}

}  // namespace
}  // namespace curvix
