// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/edge_density.h"

#include <gtest/gtest.h>
#include <cmath>
#include <functional>
#include <vector>

#include "base/angles.h"
#include "geometry/nearest_edge.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Vector2d;

constexpr int kSizePx = 800;

// Edges half a pixel apart along a straight contour, as far as in the image.
void AppendContour(const Vector2d& from,
                   double angle,
                   double length_px,
                   std::vector<Edge2d>& edges) {
  for (double s = 0; s < length_px; s += 0.5) {
    Edge2d edge;
    edge.position = from + s * Vector2d(std::cos(angle), std::sin(angle));
    edge.angle = static_cast<float>(angle);
    if (edge.position.minCoeff() >= 0 && edge.position.maxCoeff() < kSizePx) {
      edges.push_back(edge);
    }
  }
}

// Level contours, `spacing_px` apart.
std::vector<Edge2d> Stripes(double spacing_px, double angle = 0) {
  std::vector<Edge2d> edges;
  const Vector2d along(std::cos(angle), std::sin(angle));
  const Vector2d across(-along.y(), along.x());
  for (double d = -2 * kSizePx; d < 2 * kSizePx; d += spacing_px) {
    AppendContour(Vector2d(400, 400) + d * across - 2 * kSizePx * along,
                  angle,
                  4 * kSizePx,
                  edges);
  }
  return edges;
}

TEST(EdgeDensity, IsOneOverTheSpacingOfStripes) {
  for (const double degrees : {0.0, 20.0, 45.0, 89.9, 90.0, 90.1, 172.0}) {
    const double angle = DegToRad(degrees);
    for (const double spacing_px : {4.0, 8.0}) {
      const EdgeDensity density(
          {Stripes(spacing_px, angle), {}}, kSizePx, kSizePx);
      EXPECT_NEAR(density.Density({400, 400}, angle) * spacing_px, 1, 0.15)
          << degrees;
      EXPECT_NEAR(
          density.Density({400, 400}, angle + kPi) * spacing_px, 1, 0.15);
    }
  }
}

TEST(EdgeDensity, CountsOnlyLikeDirections) {
  const EdgeDensity density({Stripes(4), {}}, kSizePx, kSizePx);
  EXPECT_LE(density.Density({400, 400}, DegToRad(90)), 0.003);
  EXPECT_LE(density.Density({400, 400}, DegToRad(35)), 0.003);
  EXPECT_LE(density.Density({400, 400}, DegToRad(-35)), 0.003);
}

TEST(EdgeDensity, ThinnedContoursCountAsWhole) {
  EdgeMap whole{Stripes(4), {}};
  EdgeMap thinned;
  thinned.spacing_px = 3 * whole.spacing_px;
  for (std::size_t i = 0; i < whole.edges.size(); i += 3) {
    thinned.edges.push_back(whole.edges[i]);
  }
  const EdgeDensity density(whole, kSizePx, kSizePx);
  EXPECT_NEAR(EdgeDensity(thinned, kSizePx, kSizePx).Density({400, 400}, 0),
              density.Density({400, 400}, 0),
              0.01);
}

// Of an image that reaches beyond its size, as distorted ones do.
TEST(EdgeDensity, IsTheSameInTheMargin) {
  const EdgeDensity density({Stripes(4), {}}, 400, 400, 160);
  EXPECT_NEAR(density.Density({520, 200}, 0) * 4, 1, 0.15);
  EXPECT_NEAR(density.Density({200, 200}, 0) * 4, 1, 0.15);
}

TEST(EdgeDensity, IsLocal) {
  std::vector<Edge2d> edges;
  for (int y = 100; y < 200; y += 4) {
    AppendContour({100, static_cast<double>(y)}, 0, 100, edges);
  }
  const EdgeDensity density({edges, {}}, kSizePx, kSizePx);
  EXPECT_GT(density.Density({150, 150}, 0), 0.2);
  EXPECT_LE(density.Density({600, 600}, 0), 0.003);
}

TEST(EdgeDensity, IsPositiveEverywhereAndFiniteOutside) {
  for (const EdgeDensity& density :
       {EdgeDensity({}, kSizePx, kSizePx),
        EdgeDensity({Stripes(4), {}}, kSizePx, kSizePx)}) {
    for (const Vector2d& pixel :
         {Vector2d(0, 0), Vector2d(-50, 1e6), Vector2d(799.9, 799.9)}) {
      EXPECT_GT(density.Density(pixel, 1), 0);
      EXPECT_LT(density.Density(pixel, 1), 1);
    }
  }
}

// Compilers differ in which argument of a call they draw first.
Vector2d AnyPixel(Random& random) {
  const double y = random.Uniform(0, kSizePx);
  const double x = random.Uniform(0, kSizePx);
  return {x, y};
}

struct Chance {
  double measured = 0;  // share of random hypotheses that find an edge
  double expected = 0;  // 1 - exp(-2 gate density)
};

// Random contours against random hypotheses, with directions from these.
Chance Measure(const std::function<double(Random&)>& contour_angle,
               const std::function<double(Random&)>& hypothesis_angle) {
  Random random(5);
  std::vector<Edge2d> edges;
  for (int i = 0; i < 1500; ++i) {
    const Vector2d from = AnyPixel(random);
    const double length_px = random.Uniform(20, 100);
    AppendContour(from, contour_angle(random), length_px, edges);
  }
  const GridIndex grid(edges, 4);
  const EdgeDensity density({edges, {}}, kSizePx, kSizePx);
  const Gate gate{1, 1, std::cos(DegToRad(15))};
  const int count = 20000;
  Chance chance;
  for (int i = 0; i < count; ++i) {
    const Vector2d p = AnyPixel(random);
    const double angle = hypothesis_angle(random);
    const ImageEdge expected{p, {std::cos(angle), std::sin(angle)}};
    if (NearestEdge(grid, expected, gate)) chance.measured += 1.0 / count;
    chance.expected +=
        (1 - std::exp(-2 * gate.normal_px * density.Density(p, angle))) / count;
  }
  return chance;
}

TEST(EdgeDensity, PredictsHowOftenRandomHypothesesFindSupport) {
  const auto any = [](Random& random) { return random.Uniform(0, kPi); };
  const auto around = [](double degrees, double spread) {
    return [=](Random& random) {
      return DegToRad(degrees + spread * random.Normal());
    };
  };
  const std::vector<Chance> chances = {
      Measure(any, any),
      Measure(around(0, 0.5), around(0, 2)),    // level, as in towns
      Measure(around(90, 0.5), around(90, 2)),  // upright
      Measure(around(25, 0.5), around(32, 1)),  // like, but not the same
      Measure(around(32, 0.5), around(25, 1))};
  for (const Chance& chance : chances) {
    EXPECT_GT(chance.measured, 0.01);
    EXPECT_LT(chance.expected / chance.measured, 1.5);
    EXPECT_GT(chance.expected / chance.measured, 1 / 1.5);
  }
}

}  // namespace
}  // namespace curvix
