// SPDX-License-Identifier: BSD-3-Clause
#include "curve_kinds/blurred_images.h"

#include <gtest/gtest.h>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/random.h"

namespace curvix {
namespace {

TEST(BlurredImage, InterpolatesUpToTheLastColumnAndRow) {
  const BlurredImage image = {3, 2, 1, {10, 20, 40, 110, 120, 140}};
  const auto at = [&](float x, float y) {
    float value = 0;
    image.LookUp({&x, 1}, {&y, 1}, &value);
    return value;
  };
  EXPECT_EQ(at(0, 0), 10);
  EXPECT_EQ(at(1.5F, 0), 30);
  EXPECT_EQ(at(1.5F, 0.5F), 80);
  EXPECT_EQ(at(2, 0), 40);
  EXPECT_EQ(at(0, 1), 110);
  EXPECT_EQ(at(1.5F, 1), 130);
  EXPECT_EQ(at(2, 0.5F), 90);
  EXPECT_EQ(at(2, 1), 140);
}

TEST(BlurredImage, LooksUpAnyNumberOfPlaces) {
  BlurredImage image = {50, 40, 1, {}};
  for (int i = 0; i < 50 * 40; ++i) {
    image.pixels.push_back(static_cast<std::uint8_t>(i * i % 251));
  }
  Random random(1);
  std::vector<float> x, y;
  for (int i = 0; i < 150; ++i) {
    x.push_back(static_cast<float>(random.Uniform(0, 49)));
    y.push_back(static_cast<float>(random.Uniform(0, 39)));
  }
  std::vector<float> values(x.size());
  image.LookUp(x, y, values.data());
  for (std::size_t i = 0; i < x.size(); ++i) {
    float value = 0;
    image.LookUp({&x[i], 1}, {&y[i], 1}, &value);
    EXPECT_EQ(values[i], value);
    const auto pixel = [&](int column, int row) {
      return image.pixels[static_cast<std::size_t>(row * 50 + column)];
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

}  // namespace
}  // namespace curvix
