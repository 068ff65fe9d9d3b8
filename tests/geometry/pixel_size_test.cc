// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/pixel_size.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/test_views.h"

namespace curvix {
namespace {

// Both see the origin, 8 and 4 before them.
std::vector<PosedView> FarAndNear() {
  return {LookAt({8, 0, 0}, {0, 0, 0}), LookAt({0, 4, 0}, {0, 0, 0})};
}

TEST(PixelSize, IsDepthOverFocalLengthOfTheNearestView) {
  EXPECT_NEAR(PixelSize({0, 0, 0}, {}, FarAndNear()), 4.0 / 800, 1e-15);
  EXPECT_NEAR(PixelSize({7, 0, 0}, {}, FarAndNear()), 1.0 / 800, 1e-15);
}

TEST(PixelSize, AMovedPointMovesAPixel) {
  const std::vector<PosedView> views = {LookAt({8, 0, 0}, {0, 0, 0})};
  const Eigen::Vector3d position(1, 0.5, -0.3);
  const Eigen::Vector3d moved =
      position + PixelSize(position, {}, views) * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR((views[0].Pixel(views[0].InCamera(moved)) -
               views[0].Pixel(views[0].InCamera(position)))
                  .norm(),
              1,
              1e-9);
}

TEST(PixelSize, AsksTheSupportingViews) {
  EXPECT_NEAR(PixelSize({0, 0, 0}, {{0, 5}}, FarAndNear()), 8.0 / 800, 1e-15);
  // Behind the supporting view: all are asked.
  EXPECT_NEAR(PixelSize({9, 0, 0}, {{0, 5}}, FarAndNear()), 4.0 / 800, 1e-15);
}

TEST(PixelSize, IsZeroWhereNoViewLooks) {
  EXPECT_EQ(PixelSize({9, 5, 0}, {{0, 5}}, FarAndNear()), 0);
  EXPECT_EQ(PixelSize({0, 0, 0}, {}, {}), 0);
}

TEST(PixelSize, RefusesViewsThatAreNotThere) {
  EXPECT_THROW(PixelSize({0, 0, 0}, {{2, 0}}, FarAndNear()), std::logic_error);
}

}  // namespace
}  // namespace curvix
