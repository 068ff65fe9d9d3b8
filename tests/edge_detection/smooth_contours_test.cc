// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/curvelets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "base/angles.h"

namespace curvix {
namespace {

// Edges along one contour, each linked to the next.
struct Contour {
  std::vector<Edge2d> edges;
  std::vector<EdgeNeighbors> neighbors;

  void Add(const Eigen::Vector2d& position, double angle) {
    const auto index = static_cast<std::int32_t>(edges.size());
    Edge2d edge;
    edge.position = position;
    edge.angle = static_cast<float>(angle);
    edges.push_back(edge);
    neighbors.emplace_back();
    if (index == 0) return;
    neighbors.back().previous = index - 1;
    neighbors[neighbors.size() - 2].next = index;
  }
  Contour Smoothed() const {
    Contour smoothed = *this;
    SmoothContours(neighbors, &smoothed.edges);
    return smoothed;
  }
  // The same with normally distributed errors across and of angles.
  Contour Scattered(double sigma_px, double sigma_rad) const {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    Contour scattered = *this;
    for (Edge2d& edge : scattered.edges) {
      const double angle = static_cast<double>(edge.angle);
      edge.position += sigma_px * normal(random) *
                       Eigen::Vector2d(-std::sin(angle), std::cos(angle));
      edge.angle = static_cast<float>(angle + sigma_rad * normal(random));
    }
    return scattered;
  }
};

Contour Line(double length_px) {
  constexpr double kAngle = 0.4;
  Contour line;
  for (double s = 0; s <= length_px; s += 1.4) {
    line.Add({50 + s * std::cos(kAngle), 60 + s * std::sin(kAngle)}, kAngle);
  }
  return line;
}

Contour Arc(double radius_px) {
  Contour arc;
  for (double a = 0; a < kPi; a += 1.4 / radius_px) {
    arc.Add({100 + radius_px * std::cos(a), 100 + radius_px * std::sin(a)},
            a + kPi / 2);
  }
  return arc;
}

// Two edges of a square, with a corner between them.
Contour Corner() {
  Contour corner;
  for (int i = -20; i < 0; ++i) corner.Add({1.4 * i, 0}, 0);
  for (int i = 0; i < 20; ++i) corner.Add({0, 1.4 * i}, kPi / 2);
  return corner;
}

double TurnedBy(const Edge2d& edge, const Edge2d& other) {
  return std::abs(WrapDirected(static_cast<double>(edge.angle) -
                               static_cast<double>(other.angle)));
}

struct Errors {
  double position_px = 0;  // root mean square
  double angle_rad = 0;
};

// Of edges so far from the ends that the parabola has its full reach.
Errors ErrorsOf(const Contour& contour, const Contour& truth) {
  constexpr std::size_t kEnd = 12;
  Errors errors;
  double size = 0;
  for (std::size_t i = kEnd; i + kEnd < truth.edges.size(); ++i) {
    const Edge2d& edge = contour.edges[i];
    const Edge2d& true_edge = truth.edges[i];
    errors.position_px += (edge.position - true_edge.position).squaredNorm();
    errors.angle_rad += std::pow(TurnedBy(edge, true_edge), 2);
    size += 1;
  }
  return {std::sqrt(errors.position_px / size),
          std::sqrt(errors.angle_rad / size)};
}

// Of 23 edges, the middle of a fitted parabola has 9/4 / 23 of the variance of
// one; its slope follows from 23 positions over 31 px.
TEST(SmoothContours, TakesTheScatterFromLines) {
  const Contour truth = Line(300);
  const Contour scattered = truth.Scattered(0.2, DegToRad(4));
  const Errors before = ErrorsOf(scattered, truth);
  const Errors after = ErrorsOf(scattered.Smoothed(), truth);
  EXPECT_NEAR(before.position_px, 0.2, 0.03);
  EXPECT_LT(after.position_px, 0.4 * before.position_px);
  EXPECT_LT(after.angle_rad, DegToRad(0.5));
}

TEST(SmoothContours, TakesTheScatterFromArcs) {
  const Contour truth = Arc(60);
  const Contour scattered = truth.Scattered(0.2, DegToRad(4));
  const Errors after = ErrorsOf(scattered.Smoothed(), truth);
  EXPECT_LT(after.position_px, 0.12);
  EXPECT_LT(after.angle_rad, DegToRad(0.6));
}

TEST(SmoothContours, LeavesExactLinesAsTheyAre) {
  const Contour line = Line(60);
  const Contour smoothed = line.Smoothed();
  for (std::size_t i = 0; i < line.edges.size(); ++i) {
    EXPECT_LT((smoothed.edges[i].position - line.edges[i].position).norm(),
              1e-9);
    EXPECT_LT(TurnedBy(smoothed.edges[i], line.edges[i]), 1e-6);
  }
}

TEST(SmoothContours, LeavesExactArcsWithinATenthOfAPixel) {
  for (const double radius : {10.0, 20.0, 100.0}) {
    const Contour arc = Arc(radius);
    const Contour smoothed = arc.Smoothed();
    for (std::size_t i = 0; i < arc.edges.size(); ++i) {
      EXPECT_LT((smoothed.edges[i].position - arc.edges[i].position).norm(),
                0.1)
          << radius;
      EXPECT_LT(TurnedBy(smoothed.edges[i], arc.edges[i]), DegToRad(1))
          << radius;
    }
  }
}

TEST(SmoothContours, KeepsCorners) {
  const Contour corner = Corner();
  const Contour smoothed = corner.Smoothed();
  for (std::size_t i = 0; i < corner.edges.size(); ++i) {
    EXPECT_LT((smoothed.edges[i].position - corner.edges[i].position).norm(),
              0.5);
    if (corner.edges[i].position.norm() < 6) continue;
    EXPECT_LT(TurnedBy(smoothed.edges[i], corner.edges[i]), DegToRad(4));
  }
}

TEST(SmoothContours, LeavesShortContoursAsTheyAre) {
  const Contour contour = Line(3).Scattered(0.2, DegToRad(4));
  const Contour smoothed = contour.Smoothed();
  for (std::size_t i = 0; i < contour.edges.size(); ++i) {
    EXPECT_EQ(smoothed.edges[i].position, contour.edges[i].position);
    EXPECT_EQ(smoothed.edges[i].angle, contour.edges[i].angle);
  }
}

TEST(SmoothContours, GoesRoundClosedContours) {
  Contour circle;
  for (int i = 0; i < 30; ++i) {
    const double a = 2 * kPi * i / 30;
    circle.Add({5 * std::cos(a), 5 * std::sin(a)}, a + kPi / 2);
  }
  circle.neighbors.front().previous = 29;
  circle.neighbors.back().next = 0;
  for (const Edge2d& edge : circle.Smoothed().edges) {
    EXPECT_NEAR(edge.position.norm(), 5, 0.3);
  }
}

// Too few for a parabola.
TEST(SmoothContours, LeavesEdgesFarApartAsTheyAre) {
  for (const double ahead : {2.5, 3.0}) {
    Contour contour;
    for (const double x : {-3.0, 0.0, ahead}) contour.Add({x, 0.1 * x * x}, 0);
    const Contour smoothed = contour.Smoothed();
    for (std::size_t i = 0; i < contour.edges.size(); ++i) {
      EXPECT_EQ(smoothed.edges[i].position, contour.edges[i].position);
      EXPECT_EQ(smoothed.edges[i].angle, contour.edges[i].angle);
    }
  }
}

TEST(SmoothContours, TakesNoEdges) {
  std::vector<Edge2d> edges;
  SmoothContours({}, &edges);
  EXPECT_TRUE(edges.empty());
}

}  // namespace
}  // namespace curvix
