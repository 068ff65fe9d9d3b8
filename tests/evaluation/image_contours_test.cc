// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/image_contours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace curvix {
namespace {

constexpr int kWidth = 200;
constexpr int kHeight = 120;

double Ramp(double x) { return std::clamp(x / 4 + 0.5, 0.0, 1.0); }

// A bright rectangle whose borders, ramps of four pixels, are at x = 40 and 160,
// y = 30 and 90.
GrayImage Rectangle() {
  GrayImage image{kWidth, kHeight, {}};
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double inside = std::min(Ramp(60 - std::abs(x + 0.5 - 100)),
                                     Ramp(30 - std::abs(y + 0.5 - 60)));
      image.pixels.push_back(static_cast<float>(50 + 150 * inside));
    }
  }
  return image;
}

double DistanceToBorder(const Eigen::Vector2d& position) {
  const Eigen::Vector2d offset = position - Eigen::Vector2d(100, 60);
  return std::abs(std::max(std::abs(offset.x()) - 60,
                           std::abs(offset.y()) - 30));
}

bool IsVertical(const Edge2d& edge) {
  return std::abs(std::sin(static_cast<double>(edge.angle))) > 0.99;
}
bool IsHorizontal(const Edge2d& edge) {
  return std::abs(std::cos(static_cast<double>(edge.angle))) > 0.99;
}

TEST(FindContours, AreTheBordersOfWhatIsBright) {
  const std::vector<Edge2d> contours = FindContours(Rectangle());
  EXPECT_NEAR(static_cast<double>(contours.size()), 360, 20);
  for (const Edge2d& pixel : contours) {
    EXPECT_LE(DistanceToBorder(pixel.position), 1.5);
    EXPECT_GT(pixel.strength, 4);
    if (pixel.position.y() > 40 && pixel.position.y() < 80) {
      EXPECT_TRUE(IsVertical(pixel));
    }
    if (pixel.position.x() > 50 && pixel.position.x() < 150) {
      EXPECT_TRUE(IsHorizontal(pixel));
    }
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
    EXPECT_TRUE(IsVertical(place) || IsHorizontal(place));
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
