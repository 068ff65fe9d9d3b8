// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/edge_density.h"

#include <gtest/gtest.h>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Vector2d;

constexpr double kNormalPx = 1.5;
constexpr double kTangentialPx = 0.8;

Edge2d EdgeAtRad(double x, double y, double angle_rad) {
  Edge2d edge;
  edge.position = {x, y};
  edge.angle = static_cast<float>(angle_rad);
  return edge;
}

Vector2d Direction(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

TEST(EdgePresence, NeverDeniesAnEdgeWithinReach) {
  Random random(3);
  for (const double max_angle_deg : {0.0, 5.0, 15.0, 44.0, 60.0, 89.0, 90.0}) {
    const double max_angle = DegToRad(max_angle_deg);
    for (int trial = 0; trial < 2000; ++trial) {
      const double angle = random.Uniform(-kPi, kPi);
      // Also at the border and beyond it.
      const Vector2d place(random.Uniform(-6, 46), random.Uniform(-6, 36));
      const EdgePresence presence({EdgeAtRad(place.x(), place.y(), angle)},
                                  40,
                                  30,
                                  kNormalPx,
                                  kTangentialPx,
                                  max_angle);
      const Vector2d tangent = Direction(angle);
      const Vector2d offset =
          random.Uniform(-kTangentialPx, kTangentialPx) * tangent +
          random.Uniform(-kNormalPx, kNormalPx) *
              Vector2d(-tangent.y(), tangent.x());
      const double turned = angle + random.Uniform(-max_angle, max_angle);
      ASSERT_TRUE(presence.MayHave(place + offset, Direction(turned)))
          << place.transpose() << " " << angle << " " << turned;
      ASSERT_TRUE(presence.MayHave(place + offset, -Direction(turned)));
    }
  }
}

TEST(EdgePresence, DeniesFarPlacesAndOtherDirections) {
  const EdgePresence presence(
      {EdgeAtRad(20, 15, 0.3)}, 40, 30, kNormalPx, kTangentialPx, DegToRad(15));
  EXPECT_TRUE(presence.MayHave({20, 15}, Direction(0.3)));
  EXPECT_FALSE(presence.MayHave({20, 15}, Direction(0.3 + DegToRad(35))));
  EXPECT_FALSE(presence.MayHave({20, 15}, Direction(0.3 - DegToRad(35))));
  EXPECT_FALSE(presence.MayHave({20, 15}, Direction(0.3 + kPi / 2)));
  EXPECT_FALSE(presence.MayHave({26, 15}, Direction(0.3)));
  EXPECT_FALSE(presence.MayHave({20, 9}, Direction(0.3)));
}

// Whatever else the image shows, which decides on where bits are kept.
TEST(EdgePresence, MayHaveWhatAnyOfTheEdgesMayHave) {
  Random random(7);
  std::vector<Edge2d> edges;
  std::vector<EdgePresence> of_one;
  const auto presence_of = [](const std::vector<Edge2d>& some) {
    return EdgePresence(some, 200, 90, kNormalPx, kTangentialPx, DegToRad(15));
  };
  for (int i = 0; i < 40; ++i) {
    edges.push_back(EdgeAtRad(random.Uniform(-6, 206),
                              random.Uniform(-6, 96),
                              random.Uniform(-kPi, kPi)));
    of_one.push_back(presence_of({edges.back()}));
  }
  const EdgePresence of_all = presence_of(edges);
  int num_found = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Vector2d place(random.Uniform(-9, 209), random.Uniform(-9, 99));
    const Vector2d tangent = Direction(random.Uniform(-kPi, kPi));
    bool any = false;
    for (const EdgePresence& one : of_one) any |= one.MayHave(place, tangent);
    ASSERT_EQ(of_all.MayHave(place, tangent), any) << place.transpose();
    num_found += any;
  }
  EXPECT_GT(num_found, 100);
  EXPECT_LT(num_found, 10000);
}

TEST(EdgePresence, DeniesAllInAnImageWithoutEdges) {
  const EdgePresence presence(
      {}, 40, 30, kNormalPx, kTangentialPx, DegToRad(15));
  EXPECT_FALSE(presence.MayHave({20, 15}, {1, 0}));
}

TEST(EdgePresence, DeniesNothingUnlessItIsMade) {
  EXPECT_TRUE(EdgePresence().MayHave({20, 15}, {1, 0}));
}

}  // namespace
}  // namespace curvix
