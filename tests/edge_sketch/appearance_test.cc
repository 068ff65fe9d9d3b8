// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/evidence.h"

#include <gtest/gtest.h>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "geometry/detected_edge.h"

namespace curvix {
namespace {

// A step from `dark` to `bright`, blurred by a pixel.
Edge2d Step(double dark, double bright, double angle_deg = 0) {
  Edge2d edge;
  edge.angle = static_cast<float>(DegToRad(angle_deg));
  edge.level = Eigen::half(static_cast<float>((dark + bright) / 2));
  edge.strength = static_cast<float>((bright - dark) / std::sqrt(2 * kPi));
  edge.sharpness = 1;
  return edge;
}

TEST(AppearanceOf, TellsTheBrightnessOfBothSides) {
  const AppearanceDensity density({Step(40, 100)});
  const auto look = density.AppearanceOf(Step(40, 100), {1, 0});
  ASSERT_TRUE(look);
  EXPECT_NEAR(look->level, 70, 0.1);
  EXPECT_NEAR(look->half_contrast, 30, 0.1);
}

TEST(AppearanceOf, TurnsWithTheEdgeAndFlipsWithTheDirection) {
  const AppearanceDensity density;
  for (const double angle_deg : {0.0, 80.0, 170.0, -100.0}) {
    const Edge2d edge = Step(40, 100, angle_deg);
    const Eigen::Vector2d along = TangentAt(edge.angle);
    EXPECT_GT(density.AppearanceOf(edge, along)->half_contrast, 29);
    EXPECT_LT(density.AppearanceOf(edge, -along)->half_contrast, -29);
  }
}

TEST(AppearanceOf, IsNotKnownWithoutSharpness) {
  Edge2d edge = Step(40, 100);
  edge.sharpness = 0;
  EXPECT_FALSE(AppearanceDensity({edge}).AppearanceOf(edge, {1, 0}));
}

TEST(AppearanceOf, IsRarerWhereFewEdgesLookSo) {
  const AppearanceDensity density(
      {Step(40, 100), Step(40, 100), Step(40, 100), Step(180, 230)});
  const float frequent = density.AppearanceOf(Step(40, 100), {1, 0})->density;
  const float rare = density.AppearanceOf(Step(180, 230), {1, 0})->density;
  const float none = density.AppearanceOf(Step(0, 240), {1, 0})->density;
  EXPECT_GT(frequent, rare);
  EXPECT_GT(rare, none);
  EXPECT_GT(none, 0);
}

// Over all levels and half contrasts of either sign.
TEST(AppearanceOf, HasDensitiesThatIntegrateToOne) {
  const AppearanceDensity density(
      {Step(40, 100), Step(90, 130), Step(180, 230), Step(60, 190)});
  const double step = 2;
  double sum = 0;
  for (double level = step / 2; level < 256; level += step) {
    for (double half = step / 2; half < 128; half += step) {
      const Edge2d edge = Step(level - half, level + half);
      sum += 2 * step * step *
             static_cast<double>(density.AppearanceOf(edge, {1, 0})->density);
    }
  }
  EXPECT_NEAR(sum, 1, 0.05);
}

TEST(AppearanceOf, IsFiniteForAnyEdge) {
  Edge2d soft = Step(0, 200);
  soft.sharpness = 1e-6f;
  Edge2d dark = Step(40, 100), light = Step(40, 100);
  dark.level = Eigen::half(-300);
  light.level = Eigen::half(900);
  const AppearanceDensity density({soft, dark, light});
  for (const Edge2d& edge : {soft, dark, light}) {
    const auto look = density.AppearanceOf(edge, {1, 0});
    EXPECT_LE(look->half_contrast, 127.5f);
    EXPECT_GT(look->density, 0);
    EXPECT_GT(LikelihoodRatio(*look, *look), 1);
  }
}

TEST(LikelihoodRatio, FallsWithTheDifferenceAndTheDensity) {
  const Appearance look{100, 20, 1e-3f};
  const double same = LikelihoodRatio(look, look);
  EXPECT_GT(same, LikelihoodRatio(look, {110, 20, 1e-3f}));
  EXPECT_GT(same, LikelihoodRatio(look, {100, 25, 1e-3f}));
  EXPECT_GT(same, LikelihoodRatio({100, 20, 2e-3f}, look));
}

TEST(LikelihoodRatio, IsBelowOneForTheOtherSideAndBounded) {
  EXPECT_LT(LikelihoodRatio({100, 20, 1e-4f}, {100, -20, 1e-4f}), 1);
  EXPECT_EQ(LikelihoodRatio({100, 20, 1e-9f}, {100, 20, 1e-9f}), 15);
}

}  // namespace
}  // namespace curvix
