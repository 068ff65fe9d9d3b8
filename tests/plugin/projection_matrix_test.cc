// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/imports/projection_matrix.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "tests/plugin/import_fixtures.h"

namespace curvix {
namespace {

void ExpectSamePose(const Rigid3& a, const Rigid3& b, double tolerance) {
  const Rigid3 motion = a * b.Inverse();
  EXPECT_LT(motion.rotation.vec().norm(), tolerance);
  EXPECT_LT(motion.translation.norm(), tolerance);
}

TEST(ProjectionMatrix, ComesApartWhateverItsFactor) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const Rigid3 pose = RandomPose(random);
    Eigen::Matrix3d k = TestCalibration();
    k(0, 1) = i - 50;
    for (const double factor : {1.0, -1.0, 1e-6, -3e7}) {
      const auto parts = DecomposeProjection(factor * k * Matrix34(pose));
      ASSERT_TRUE(parts.has_value());
      EXPECT_TRUE(parts->calibration.isApprox(k, 1e-10));
      EXPECT_EQ(parts->calibration(2, 2), 1);
      ExpectSamePose(parts->cam_from_world, pose, 1e-10);
    }
  }
}

TEST(ProjectionMatrix, KeepsThePlaceOfTheCameraWithAnotherCalibration) {
  std::mt19937 random(2);
  const Rigid3 pose = RandomPose(random);
  Eigen::Matrix3d near = TestCalibration();
  near(0, 0) += 0.01;
  const Rigid3 found =
      PoseOfProjection(TestCalibration() * Matrix34(pose), near);
  EXPECT_LT((found.Inverse().translation - pose.Inverse().translation).norm(),
            1e-10);
  ExpectSamePose(found, pose, 1e-4);
}

TEST(ProjectionMatrix, HasNoAnswerWhereThereIsNone) {
  EXPECT_FALSE(DecomposeProjection(Matrix34d::Zero()));
  Matrix34d affine = Matrix34d::Identity();
  affine.row(2) << 0, 0, 0, 1;
  EXPECT_FALSE(DecomposeProjection(affine));
  Matrix34d hole = Matrix34d::Identity();
  hole(1, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(DecomposeProjection(hole));
}

TEST(RotationFromMatrix, TakesScaledRotationsOnly) {
  std::mt19937 random(3);
  const Eigen::Matrix3d r = RandomPose(random).rotation.toRotationMatrix();
  for (const double scale : {1.0, 0.01, 100.0}) {
    const auto rotation = RotationFromMatrix(scale * r);
    ASSERT_TRUE(rotation.has_value());
    EXPECT_TRUE(rotation->toRotationMatrix().isApprox(r, 1e-12));
  }
  EXPECT_FALSE(RotationFromMatrix(-r));
  EXPECT_FALSE(RotationFromMatrix(Eigen::Matrix3d::Zero()));
  Eigen::Matrix3d sheared = r;
  sheared.col(0) *= 1.01;
  EXPECT_FALSE(RotationFromMatrix(sheared));
}

TEST(CameraFromCalibration, MovesTheFirstPixelToAHalf) {
  const Eigen::Matrix3d k = TestCalibration();
  EXPECT_THAT(CameraFromCalibration(k, 640, 480, 0)->params,
              testing::ElementsAre(700, 710, 310.5, 245.5));
  EXPECT_THAT(CameraFromCalibration(k, 640, 480, 1)->params,
              testing::ElementsAre(700, 710, 309.5, 244.5));
  EXPECT_THAT(CameraFromCalibration(2 * k, 640, 480, 0.5)->params,
              testing::ElementsAre(700, 710, 310, 245));
}

TEST(CameraFromCalibration, RefusesSkewThatShows) {
  Eigen::Matrix3d k = TestCalibration();
  k(0, 1) = 0.1;  // 0.034 px at the border
  EXPECT_TRUE(CameraFromCalibration(k, 640, 480, 0).ok());
  k(0, 1) = 1;
  EXPECT_EQ(CameraFromCalibration(k, 640, 480, 0).status().code(),
            StatusCode::kUnsupported);
  k = TestCalibration();
  k(2, 1) = 1e-3;
  EXPECT_EQ(CameraFromCalibration(k, 640, 480, 0).status().code(),
            StatusCode::kDataLoss);
}

}  // namespace
}  // namespace curvix
