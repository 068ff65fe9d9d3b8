// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/consolidate.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>

#include "base/angles.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Vector2d;

constexpr double kTolerancePx = 0.3;
const Line2 kXAxis{{0, 1}, 0};

Vector2d DirectionDeg(double degrees) {
  return {std::cos(DegToRad(degrees)), std::sin(DegToRad(degrees))};
}

double AngleDeg(const Vector2d& a, const Vector2d& b) {
  return RadToDeg(
      UndirectedDifference(std::atan2(a.y(), a.x()), std::atan2(b.y(), b.x())));
}

std::optional<ImageEdge> Slide(double height_px,
                               double degrees,
                               const ConsolidationOptions& options = {}) {
  return SlideToLine(
      {{10, height_px}, DirectionDeg(degrees)}, kXAxis, kTolerancePx, options);
}

TEST(SlideToLine, LandsOnTheLineAndKeepsItsTangent) {
  // tan 45 = 1: one pixel down is one pixel along.
  for (const double degrees : {45.0, -135.0}) {
    const auto moved = Slide(2, degrees);
    ASSERT_TRUE(moved);
    EXPECT_LT((moved->position - Vector2d(8, 0)).norm(), 1e-12);
    EXPECT_LT(AngleDeg(moved->tangent, DirectionDeg(45)), 1e-6);
  }
}

TEST(SlideToLine, SlidesNoFurtherThanTheLimit) {
  ConsolidationOptions no_turn;
  no_turn.max_turn_deg = 0;
  const double sine = std::sin(DegToRad(30));
  EXPECT_TRUE(Slide(2.99 * sine, 30, no_turn));
  EXPECT_FALSE(Slide(3.01 * sine, 30, no_turn));
  EXPECT_TRUE(Slide(-2.99 * sine, 30, no_turn));
  EXPECT_FALSE(Slide(-3.01 * sine, 30, no_turn));
}

TEST(SlideToLine, TurnsTowardsTheLineWhereTheSlideIsTooLong) {
  // At 20 degrees 1.2 px are 3.5 px away; at 30 degrees, 2.4.
  for (const double height : {1.2, -1.2}) {
    for (const double sign : {1.0, -1.0}) {
      for (const double half_turn : {0.0, 180.0}) {
        const auto moved = Slide(height, half_turn + sign * 20);
        ASSERT_TRUE(moved) << height << " px, sign " << sign;
        EXPECT_NEAR(moved->position.y(), 0, 1e-12);
        EXPECT_NEAR(moved->position.x(),
                    10 - sign * height / std::tan(DegToRad(30)),
                    1e-9);
        EXPECT_LT(AngleDeg(moved->tangent, DirectionDeg(sign * 30)), 1e-6);
      }
    }
  }
}

TEST(SlideToLine, TurnsNoFurtherThanTheNormalOfTheLine) {
  const auto moved = Slide(3 - 1e-9, 85);  // 3.01 px at 85 degrees, 3 at 90
  ASSERT_TRUE(moved);
  EXPECT_LT((moved->position - Vector2d(10, 0)).norm(), 1e-8);
  EXPECT_LT(AngleDeg(moved->tangent, DirectionDeg(90)), 1e-6);
}

TEST(SlideToLine, DropsWhatIsTooFarEvenTurned) {
  const double reach = 3 * std::sin(DegToRad(30));
  EXPECT_TRUE(Slide(0.999 * reach, 20));
  EXPECT_FALSE(Slide(1.001 * reach, 20));
  EXPECT_FALSE(Slide(3.1, 90));
}

TEST(SlideToLine, ShiftsAlongTheNormalWhatRunsAlongTheLineWithinTheTolerance) {
  ConsolidationOptions no_turn;
  no_turn.max_turn_deg = 0;
  for (const double height : {0.29, -0.29}) {
    const auto moved = Slide(height, 1, no_turn);
    ASSERT_TRUE(moved);
    EXPECT_LT((moved->position - Vector2d(10, 0)).norm(), 1e-12);
    EXPECT_LT(AngleDeg(moved->tangent, DirectionDeg(1)), 1e-6);
  }
  EXPECT_FALSE(Slide(0.31, 1, no_turn));
  EXPECT_FALSE(Slide(-0.31, 0, no_turn));
}

TEST(SlideToLine, LeavesEdgesOnTheLineWhereTheyAre) {
  for (const double degrees : {0.0, 0.001, 90.0, 180.0}) {
    const auto moved = Slide(0, degrees);
    ASSERT_TRUE(moved);
    EXPECT_LT((moved->position - Vector2d(10, 0)).norm(), 1e-12);
  }
}

TEST(SlideToLine, DoesNotDependOnTheSignsOfNormalAndTangent) {
  Random random(1);
  ConsolidationOptions options;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector2d normal = DirectionDeg(random.Uniform(-180, 180));
    const Line2 line{normal, random.Uniform(-500, 500)};
    ImageEdge edge;
    // Some run exactly along the line.
    edge.tangent = trial % 10 == 0 ? line.Direction()
                                   : DirectionDeg(random.Uniform(-180, 180));
    edge.position = random.Uniform(-500, 500) * line.Direction() +
                    (random.Uniform(-3.5, 3.5) - line.offset) * normal;
    options.max_turn_deg = trial % 3 == 0 ? 0 : 10;
    const auto moved = SlideToLine(edge, line, kTolerancePx, options);
    for (const double tangent_sign : {1.0, -1.0}) {
      for (const double normal_sign : {1.0, -1.0}) {
        const auto same =
            SlideToLine({edge.position, tangent_sign * edge.tangent},
                        {normal_sign * normal, normal_sign * line.offset},
                        kTolerancePx,
                        options);
        ASSERT_EQ(same.has_value(), moved.has_value());
        if (!moved) continue;
        EXPECT_LT((same->position - moved->position).norm(), 1e-9);
        EXPECT_LT(AngleDeg(same->tangent, moved->tangent), 1e-6);
        EXPECT_LT(std::abs(line.SignedDistance(same->position)), 1e-12);
      }
    }
  }
}

TEST(SlideToLine, NeverMovesFurtherThanTheLongestSlide) {
  Random random(2);
  int moved_count = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const ImageEdge edge{{0, random.Uniform(-3.5, 3.5)},
                         DirectionDeg(random.Uniform(-180, 180))};
    const auto moved = SlideToLine(edge, kXAxis, kTolerancePx, {});
    if (!moved) continue;
    ++moved_count;
    EXPECT_LE((moved->position - edge.position).norm(), 3 + 1e-9);
    EXPECT_LE(AngleDeg(moved->tangent, edge.tangent), 10 + 1e-6);
  }
  EXPECT_GT(moved_count, 1000);
}

}  // namespace
}  // namespace curvix
