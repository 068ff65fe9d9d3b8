// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/pixel_size.h"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(PixelSize, PrefersViewsThatHaveThePlaceInTheirImage) {
  // 2 before the second view, but far beside what it shows.
  const std::vector<PosedView> views = {LookAt({8, 0, 0}, {0, 0, 0}),
                                        LookAt({0, 4, 9}, {0, 0, 9})};
  EXPECT_NEAR(PixelSize({0, 2, 0}, {}, views), 8.0 / 800, 1e-15);
}

TEST(PixelSize, RefusesViewsThatAreNotThere) {
  EXPECT_THROW(PixelSize({0, 0, 0}, {{2, 0}}, FarAndNear()), std::logic_error);
}

TEST(PixelSizeAlong, AStepAlongTheEdgeIsAPixelLong) {
  const std::vector<PosedView> views = {LookAt({8, 0, 0}, {0, 0, 0})};
  for (const Eigen::Vector3d& along :
       {Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(1, 1, 0.4)}) {
    const SpaceEdge edge{{1, 0.5, -0.3}, along.normalized()};
    // A thousandth of it, since projection is not linear.
    const Eigen::Vector3d moved =
        edge.position +
        1e-3 * PixelSizeAlong(edge, {{0, 0}}, views) * edge.tangent;
    EXPECT_NEAR((views[0].Pixel(views[0].InCamera(moved)) -
                 views[0].Pixel(views[0].InCamera(edge.position)))
                    .norm(),
                1e-3,
                1e-6);
  }
}

TEST(PixelSizeAlong, IsThatOfTheViewThatSeesTheEdgeLargest) {
  const double depth_over_focal = 8.0 / 800;
  const std::vector<PosedView> views = {LookAt({8, 0, 0}, {0, 0, 0}),
                                        LookAt({0, 8, 0}, {0, 0, 0})};
  const double root3 = std::sqrt(3.0);
  const SpaceEdge edge{{0, 0, 0}, {root3 / 2, 0.5, 0}};
  EXPECT_NEAR(
      PixelSizeAlong(edge, {{0, 0}}, views), 2 * depth_over_focal, 1e-12);
  EXPECT_NEAR(PixelSizeAlong(edge, {{0, 0}, {1, 0}}, views),
              2 / root3 * depth_over_focal,
              1e-12);
}

TEST(PixelSizeAlong, IsZeroBehindTheViewsAndInfiniteTowardsThem) {
  const std::vector<PosedView> views = {LookAt({8, 0, 0}, {0, 0, 0})};
  EXPECT_EQ(PixelSizeAlong({{9, 0, 0}, {0, 1, 0}}, {{0, 0}}, views), 0);
  EXPECT_GT(PixelSizeAlong({{0, 0, 0}, {1, 0, 0}}, {{0, 0}}, views), 1e9);
}

}  // namespace
}  // namespace curvix
