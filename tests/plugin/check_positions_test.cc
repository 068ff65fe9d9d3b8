// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/positions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <string>
#include <utility>

namespace curvix {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Ten cameras around the origin whose heights differ by up to `height`, at ten
// times the scale and to about 0.02.
AlignmentInput CamerasAround(double height, double sigma) {
  AlignmentInput input;
  for (int i = 0; i < 10; ++i) {
    const double angle = 0.6 * i;
    const Eigen::Vector3d x(
        3 * std::cos(angle), 3 * std::sin(angle), height * std::sin(3 * angle));
    const Eigen::Vector3d error(
        0.02 * std::sin(7 * angle), 0.02 * std::cos(5 * angle), 0);
    input.positions.push_back(
        {"image " + std::to_string(i), x, 10 * x + error, sigma});
  }
  return input;
}

void SwapXAndY(AlignmentInput& input) {
  for (KnownPosition& p : input.positions) std::swap(p.world.x(), p.world.y());
}

// "" if all is well.
std::string WrongWith(const AlignmentInput& input, bool z_is_up) {
  const Result<AlignmentResult> result = EstimateAlignment(input);
  EXPECT_TRUE(result.ok()) << result.status().message();
  return CheckPositions(input, *result, {{0, 0, 1}, {0, 0, 0}}, z_is_up)
      .message();
}

TEST(CheckPositions, AcceptsThoseOfTheCameras) {
  for (const double height : {0.0, 0.3}) {
    for (const double sigma : {0.0, 0.02}) {
      EXPECT_EQ(WrongWith(CamerasAround(height, sigma), true), "");
    }
  }
  AlignmentInput without_positions;
  without_positions.axes.emplace();
  EXPECT_EQ(WrongWith(without_positions, true), "");
}

TEST(CheckPositions, TellsThatXAndYAreSwapped) {
  for (const double sigma : {0.0, 0.02}) {
    AlignmentInput input = CamerasAround(0.3, sigma);
    SwapXAndY(input);
    EXPECT_THAT(WrongWith(input, false),
                HasSubstr("better with x and y swapped"));
  }
}

// The heights of cameras in a plane do not tell a mirror.
TEST(CheckPositions, TellsThatCamerasAreUpsideDown) {
  AlignmentInput input = CamerasAround(0, 0);
  SwapXAndY(input);
  EXPECT_THAT(WrongWith(input, true), HasSubstr("upside down"));
  EXPECT_EQ(WrongWith(input, false), "") << "z may be a depth";
}

TEST(CheckPositions, RefusesThoseOfOtherCameras) {
  for (const double sigma : {0.0, 0.02}) {
    AlignmentInput input = CamerasAround(0.3, sigma);
    for (std::size_t i = 0; i < 5; ++i) {
      std::swap(input.positions[i].world, input.positions[9 - i].world);
    }
    std::swap(input.positions[1].world, input.positions[6].world);
    EXPECT_THAT(WrongWith(input, false), HasSubstr("do not fit the cameras"));
  }
  EXPECT_EQ(WrongWith(CamerasAround(0.3, 20), false), "")
      << "as uncertain as it says";
}

// Cameras that look down have no mean up.
TEST(CheckPositions, TellsThatCamerasLookToTheSky) {
  AlignmentInput input = CamerasAround(0, 0);
  SwapXAndY(input);
  const Result<AlignmentResult> result = EstimateAlignment(input);
  ASSERT_TRUE(result.ok());
  const MeanDirections down = {{0, 0, 0}, {0, 0, -1}};
  EXPECT_THAT(CheckPositions(input, *result, down, true).message(),
              HasSubstr("upside down"));
}

TEST(CheckPositions, AWrongDistanceIsNoSwap) {
  AlignmentInput input = CamerasAround(0.3, 0.02);
  input.distances.push_back({.b = {1, 0, 0}, .length = 11, .sigma = 1e-6});
  EXPECT_THAT(WrongWith(input, true), Not(HasSubstr("swapped")));
}

TEST(CheckPositions, NamesTheWorst) {
  AlignmentInput input = CamerasAround(0.3, 0);
  input.positions[4].world.z() += 5;
  const Result<AlignmentResult> result = EstimateAlignment(input);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(WorstOf(*result), 4u);
}

}  // namespace
}  // namespace curvix
