// SPDX-License-Identifier: BSD-3-Clause
#include "model/posed_view.h"

#include <curvix/scene.h>
#include <gtest/gtest.h>

#include "tests/support/random.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

TEST(MakePosedViews, TakesPoseAndCalibrationOfEachView) {
  Random random(1);
  std::vector<PosedView> expected;
  for (int i = 0; i < 5; ++i) {
    expected.push_back(MakeView(random.Rotation(), random.NormalVector()));
    expected.back().calibration(1, 1) = 500 + i;
    expected.back().width = 640 + i;
  }
  const std::vector<PosedView> made = MakePosedViews(ToScene(expected));
  ASSERT_EQ(made.size(), expected.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    EXPECT_EQ(made[i].calibration, expected[i].calibration);
    EXPECT_EQ(made[i].width, expected[i].width);
    EXPECT_EQ(made[i].height, 800);
    EXPECT_TRUE(made[i].rotation.isApprox(expected[i].rotation, 1e-12));
    EXPECT_TRUE(made[i].center.isApprox(expected[i].center, 1e-12));
    EXPECT_LT(made[i].InCamera(expected[i].center).norm(), 1e-12);
  }
}

TEST(MakePosedViews, SharesACameraBetweenViews) {
  Scene scene = ToScene({MakeView(Eigen::Matrix3d::Identity(), {0, 0, 0}),
                         MakeView(Eigen::Matrix3d::Identity(), {1, 0, 0})});
  scene.cameras[1].params = {100, 100, 50, 50};
  scene.views[0].camera_idx = 1;
  for (const PosedView& view : MakePosedViews(scene)) {
    EXPECT_EQ(view.calibration(0, 0), 100);
  }
}

// The margin of a camera of 800 x 600 pixels with radial distortion `k`.
double MarginOf(double k) {
  Scene scene = ToScene({MakeView(Eigen::Matrix3d::Identity(), {0, 0, 0})});
  scene.cameras[0] = {CameraModel::kSimpleRadial, 800, 600, {700, 400, 300, k}};
  return MakePosedViews(scene)[0].margin_px;
}

TEST(MakePosedViews, MarginIsHowFarTheIdealImageReachesBeyondItsFrame) {
  EXPECT_EQ(MarginOf(0.0), 0);
  EXPECT_EQ(MarginOf(0.1), 0);  // drawn inwards: all lies within
  const Camera camera = {
      CameraModel::kSimpleRadial, 800, 600, {700, 400, 300, -0.1}};
  const auto corner = IdealFromImage(camera, {0, 0});  // farthest
  ASSERT_TRUE(corner.has_value());
  const double expected = -(700 * corner->x() + 400);
  EXPECT_GT(expected, 10);
  EXPECT_NEAR(MarginOf(-0.1), expected, 1e-9);
}

TEST(MakePosedViews, MarginIsAtMostTheLongerSide) {
  EXPECT_EQ(MarginOf(-0.5), 800);  // corners have no ideal pixel
}

}  // namespace
}  // namespace curvix
