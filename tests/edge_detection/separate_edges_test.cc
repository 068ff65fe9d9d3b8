// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/detect_view_edges.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/edge_detection/oriented_edges.h"
#include "tests/support/picture.h"

namespace curvix {
namespace {

constexpr double kBlurPx = 1.2;
constexpr double kTurn = 0.4;  // of all lines, radians
const Eigen::Vector2d kTangent(std::cos(kTurn), std::sin(kTurn));
const Eigen::Vector2d kAcross(-std::sin(kTurn), std::cos(kTurn));

// On a line so far across the others, brighter ahead if `strength` > 0.
Edge2d EdgeAcross(double across_px, double strength) {
  Edge2d edge;
  edge.position = Eigen::Vector2d(50, 50) + across_px * kAcross;
  edge.angle =
      static_cast<float>(kTurn + (strength > 0 ? 0 : std::numbers::pi));
  edge.strength = static_cast<float>(std::abs(strength));
  edge.sharpness = static_cast<float>(1 / (kBlurPx * kBlurPx));
  return edge;
}

double AcrossOf(const Edge2d& edge) {
  return kAcross.dot(edge.position - Eigen::Vector2d(50, 50));
}

// Two steps of heights 20 and `height`, blurred. Brightness changes where
// both do.
struct TwoSteps {
  double distance_px;
  double height;

  double Gradient(double x) const {
    const double r = x / kBlurPx, q = (x - distance_px) / kBlurPx;
    return 20 * std::exp(-r * r / 2) + height * std::exp(-q * q / 2);
  }
  // The place of the peak of the step at `start`, by small moves uphill.
  double PeakNear(double start) const {
    double x = start;
    const double sign = Gradient(x) > 0 ? 1 : -1;
    for (double step = 0.1; step > 1e-5; step /= 2) {
      while (sign * Gradient(x + step) > sign * Gradient(x)) x += step;
      while (sign * Gradient(x - step) > sign * Gradient(x)) x -= step;
    }
    return x;
  }
  // What a detector finds of them.
  std::array<Edge2d, 2> Edges() const {
    const double first = PeakNear(0), second = PeakNear(distance_px);
    return {EdgeAcross(first, Gradient(first)),
            EdgeAcross(second, Gradient(second))};
  }
};

// With more edges that stand alone.
std::vector<Edge2d> AmongOthers(const std::array<Edge2d, 2>& edges) {
  return {EdgeAcross(-40, 20),
          edges[0],
          edges[1],
          EdgeAcross(40, 20),
          EdgeAcross(25, 20)};
}

TEST(SeparateEdges, TwoStepsStandWhereTheyAre) {
  for (const double height : {-20.0, -12.0, -40.0, 20.0, 30.0}) {
    for (const double distance_px : {3.2, 3.6, 4.2}) {
      std::vector<Edge2d> edges =
          AmongOthers(TwoSteps{distance_px, height}.Edges());
      SeparateEdges(EdgeMap().spacing_px, &edges);
      EXPECT_NEAR(AcrossOf(edges[1]), 0, 0.05) << height << ' ' << distance_px;
      EXPECT_NEAR(AcrossOf(edges[2]), distance_px, 0.05)
          << height << ' ' << distance_px;
    }
  }
}

TEST(SeparateEdges, AThinLineIsNotAsThickAsItsBlur) {
  for (const double width_px : {1.0, 1.5, 2.0, 2.5}) {
    std::vector<Edge2d> edges = AmongOthers(TwoSteps{width_px, -20}.Edges());
    const double seen_px = AcrossOf(edges[2]) - AcrossOf(edges[1]);
    SeparateEdges(EdgeMap().spacing_px, &edges);
    const double separated_px = AcrossOf(edges[2]) - AcrossOf(edges[1]);
    EXPECT_GT(seen_px, 2 * kBlurPx);
    EXPECT_LT(std::abs(separated_px - width_px), 0.5 * (seen_px - width_px));
  }
}

// Across `edges[0]`, by how much it moved.
double MoveOfFirst(const std::vector<Edge2d>& edges) {
  std::vector<Edge2d> separated = edges;
  SeparateEdges(EdgeMap().spacing_px, &separated);
  return (separated[0].position - edges[0].position).norm();
}

TEST(SeparateEdges, EdgesAloneStay) {
  EXPECT_EQ(MoveOfFirst({EdgeAcross(0, 20)}), 0);
  EXPECT_EQ(MoveOfFirst({EdgeAcross(0, 20), EdgeAcross(6, -20)}), 0);
}

TEST(SeparateEdges, EdgesOnTheSameLineStay) {
  Edge2d next = EdgeAcross(0.1, 20);
  next.position += 0.5 * kTangent;
  EXPECT_EQ(MoveOfFirst({EdgeAcross(0, 20), next}), 0);
}

TEST(SeparateEdges, EdgesThatCrossStay) {
  Edge2d crossing = EdgeAcross(3, 20);
  crossing.angle += static_cast<float>(std::numbers::pi / 2);
  EXPECT_EQ(MoveOfFirst({EdgeAcross(0, 20), crossing}), 0);
}

TEST(SeparateEdges, WithoutSharpnessAllStay) {
  std::vector<Edge2d> edges = {EdgeAcross(0, 20), EdgeAcross(3, -20)};
  for (Edge2d& edge : edges) edge.sharpness = 0;
  EXPECT_EQ(MoveOfFirst(edges), 0);
  std::vector<Edge2d> none;
  SeparateEdges(EdgeMap().spacing_px, &none);
  EXPECT_TRUE(none.empty());
}

// Two wide bars side by side, and a thin line.
GrayImage Bars(double line_px) {
  return Picture(100, 60, [&](const Eigen::Vector2d& place) {
    const double across = kAcross.dot(place - Eigen::Vector2d(50, 30));
    return (across > -30 && across < -20) || (across > -10 && across < 0) ||
           (across > 15 && across < 15 + line_px);
  });
}

// The mean distance between both sides of the thin line.
double LineWidth(const std::vector<Edge2d>& edges) {
  std::array<double, 2> sums = {}, counts = {};
  for (const Edge2d& edge : edges) {
    const double across = kAcross.dot(edge.position - Eigen::Vector2d(50, 30));
    const double along = kTangent.dot(edge.position - Eigen::Vector2d(50, 30));
    if (across < 10 || std::abs(along) > 8) continue;
    const bool rises = std::cos(static_cast<double>(edge.angle) - kTurn) > 0;
    const std::size_t side = rises ? 0 : 1;
    sums[side] += across;
    counts[side] += 1;
  }
  return sums[1] / counts[1] - sums[0] / counts[0];
}

TEST(SeparateEdges, UndoesWhatTheDetectorDoesToThinLines) {
  for (const double line_px : {2.0, 2.5, 3.0}) {
    std::vector<Edge2d> edges = OrientedEdges(Bars(line_px), {}, 5);
    const double seen_px = LineWidth(edges);
    SeparateEdges(EdgeMap().spacing_px, &edges);
    EXPECT_GT(seen_px, line_px + 0.05);
    EXPECT_LT(std::abs(LineWidth(edges) - line_px), 0.3 * (seen_px - line_px));
  }
}

}  // namespace
}  // namespace curvix
