// SPDX-License-Identifier: BSD-3-Clause
#include "curve_kinds/blurred_images.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace curvix
