// SPDX-License-Identifier: BSD-3-Clause
#include "curve_kinds/blurred_images.h"

#include <gtest/gtest.h>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Vector2i;

// The grey level at one place.
float At(const BlurredImage& image, float x, float y) {
  float value = 0;
  image.LookUp({&x, 1}, {&y, 1}, &value);
  return value;
}

TEST(BlurredImage, InterpolatesUpToTheLastColumnAndRow) {
  BlurredImage image(3, 2, 1);
  image.AskFor({Vector2i(0, 0), Vector2i(2, 1)});
  image.Keep(std::vector<std::uint8_t>{10, 20, 40, 110, 120, 140}, 0);
  EXPECT_EQ(At(image, 0, 0), 10);
  EXPECT_EQ(At(image, 1.5F, 0), 30);
  EXPECT_EQ(At(image, 1.5F, 0.5F), 80);
  EXPECT_EQ(At(image, 2, 0), 40);
  EXPECT_EQ(At(image, 0, 1), 110);
  EXPECT_EQ(At(image, 1.5F, 1), 130);
  EXPECT_EQ(At(image, 2, 0.5F), 90);
  EXPECT_EQ(At(image, 2, 1), 140);
}

TEST(BlurredImage, LooksUpAnyNumberOfPlaces) {
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < 50 * 40; ++i) {
    pixels.push_back(static_cast<std::uint8_t>(i * i % 251));
  }
  BlurredImage image(50, 40, 1);
  image.AskFor({Vector2i(0, 0), Vector2i(49, 39)});
  image.Keep(pixels, 0);
  Random random(1);
  std::vector<float> x, y;
  for (int i = 0; i < 150; ++i) {
    x.push_back(static_cast<float>(random.Uniform(0, 49)));
    y.push_back(static_cast<float>(random.Uniform(0, 39)));
  }
  std::vector<float> values(x.size());
  image.LookUp(x, y, values.data());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const float value = At(image, x[i], y[i]);
    EXPECT_EQ(values[i], value);
    const auto pixel = [&](int column, int row) {
      return pixels[static_cast<std::size_t>(row * 50 + column)];
    };
    const int column = static_cast<int>(x[i]), row = static_cast<int>(y[i]);
    const float right = x[i] - static_cast<float>(column);
    const float below = y[i] - static_cast<float>(row);
    EXPECT_NEAR(value,
                (1 - below) * ((1 - right) * pixel(column, row) +
                               right * pixel(column + 1, row)) +
                    below * ((1 - right) * pixel(column, row + 1) +
                             right * pixel(column + 1, row + 1)),
                1e-3);
  }
}

TEST(BlurredImage, HoldsTheTilesOfBoxesAskedFor) {
  constexpr int kWidth = 1000, kHeight = 700;
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    pixels.push_back(static_cast<std::uint8_t>(i % 241));
  }
  BlurredImage some(kWidth, kHeight, 1), all(kWidth, kHeight, 1);
  EXPECT_FALSE(some.IsAskedFor());
  const std::vector<Eigen::AlignedBox2i> boxes = {
      {Vector2i(15, 15), Vector2i(16, 16)},
      {Vector2i(20, 10), Vector2i(70, 40)},
      {Vector2i(960, 680), Vector2i(999, 699)}};
  for (const auto& box : boxes) some.AskFor(box);
  EXPECT_TRUE(some.IsAskedFor());
  all.AskFor({Vector2i(0, 0), Vector2i(kWidth - 1, kHeight - 1)});
  some.Keep(pixels, 2);
  all.Keep(pixels, 2);
  EXPECT_EQ(some.noise_variance(), 2);
  // The first two boxes share two tiles.
  EXPECT_EQ(some.NumKept(), (2 * 2 + 4 * 3 - 2 + 3 * 2) * 17 * 17);
  Random random(1);
  for (const auto& box : boxes) {
    for (int i = 0; i < 100; ++i) {
      const auto x =
          static_cast<float>(random.Uniform(box.min().x(), box.max().x()));
      const auto y =
          static_cast<float>(random.Uniform(box.min().y(), box.max().y()));
      EXPECT_EQ(At(some, x, y), At(all, x, y)) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace curvix
