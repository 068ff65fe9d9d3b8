// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/image_agreement.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/angles.h"

namespace curvix {
namespace {

constexpr int kWidth = 200;
constexpr int kHeight = 160;
constexpr double kAngle = 0.2;

double Ramp(double x) { return std::clamp(x / 4 + 0.5, 0.0, 1.0); }

// From the middle of the image, along the axes of the rectangle.
Eigen::Vector2d InRectangle(const Eigen::Vector2d& position) {
  return Eigen::Rotation2Dd(-kAngle) *
         (position - Eigen::Vector2d(kWidth / 2.0, kHeight / 2.0));
}

// A bright rectangle of 120 x 60 pixels, turned by kAngle, with ramps of four
// pixels for borders.
GrayImage Rectangle() {
  GrayImage image{kWidth, kHeight, {}};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Eigen::Vector2d place = InRectangle({x + 0.5, y + 0.5});
      const double inside = std::min(Ramp(60 - std::abs(place.x())),
                                     Ramp(30 - std::abs(place.y())));
      image.pixels.push_back(static_cast<float>(50 + 150 * inside));
    }
  }
  return image;
}

double DistanceToBorder(const Eigen::Vector2d& position) {
  const Eigen::Vector2d place = InRectangle(position);
  return std::abs(std::max(std::abs(place.x()) - 60, std::abs(place.y()) - 30));
}

// Whether the edge has the direction of the nearer side; not near corners.
bool IsAlongItsSide(const Edge2d& edge) {
  const Eigen::Vector2d place = InRectangle(edge.position);
  const double to_long_side = 30 - std::abs(place.y());
  const double to_short_side = 60 - std::abs(place.x());
  if (std::abs(to_long_side - to_short_side) < 8) return true;
  const double angle = to_long_side < to_short_side ? kAngle : kAngle + kPi / 2;
  return UndirectedDifference(static_cast<double>(edge.angle), angle) < 0.15;
}

TEST(FindContours, AreTheBordersOfWhatIsBright) {
  const std::vector<Edge2d> contours = FindContours(Rectangle());
  EXPECT_NEAR(static_cast<double>(contours.size()), 350, 30);
  for (const Edge2d& pixel : contours) {
    EXPECT_LE(DistanceToBorder(pixel.position), 1.5);
    EXPECT_GT(pixel.strength, 4);
    EXPECT_TRUE(IsAlongItsSide(pixel)) << pixel.position.transpose();
  }
}

TEST(FindContours, LeavesOutWhatIsShort) {
  GrayImage image{kWidth, kHeight, {}};
  image.pixels.assign(static_cast<std::size_t>(kWidth * kHeight), 50.0f);
  for (int y = 50; y < 54; ++y) {
    for (int x = 50; x < 54; ++x) {
      image.pixels[static_cast<std::size_t>(y * kWidth + x)] = 200;
    }
  }
  EXPECT_TRUE(FindContours(image).empty());
}

TEST(FindLongLines, AreTheSides) {
  const std::vector<Edge2d> places = FindLongLines(Rectangle());
  EXPECT_NEAR(static_cast<double>(places.size()), 360, 30);
  for (const Edge2d& place : places) {
    EXPECT_LE(DistanceToBorder(place.position), 1.5);
    EXPECT_TRUE(IsAlongItsSide(place)) << place.position.transpose();
  }
}

TEST(FindLongLines, AreNoneWhereNothingIs) {
  GrayImage image{kWidth, kHeight, {}};
  image.pixels.assign(static_cast<std::size_t>(kWidth * kHeight), 50.0f);
  EXPECT_TRUE(FindLongLines(image).empty());
  EXPECT_TRUE(FindContours(image).empty());
}

}  // namespace
}  // namespace curvix
