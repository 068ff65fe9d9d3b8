// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/similarity.h"

#include <limits>
#include <random>

#include "gtest/gtest.h"

namespace curvix {
namespace {

Eigen::Vector3d RandomVector(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double x = unit(random);
  const double y = unit(random);
  return {x, y, unit(random)};
}

Rigid3 PoseAt(const Eigen::Vector3d& center, std::mt19937& random) {
  const Eigen::Vector3d axis = RandomVector(random);
  const Eigen::Quaterniond rotation(
      Eigen::AngleAxisd(axis.norm(), axis.normalized()));
  return {rotation, rotation * -center};
}

// Centres spread in space, on a plane, on a line, or at one place.
std::vector<Rigid3> Poses(int num_dimensions) {
  std::mt19937 random(3);
  std::vector<Rigid3> poses;
  for (int i = 0; i < 9; ++i) {
    Eigen::Vector3d center = RandomVector(random);
    center.tail(3 - num_dimensions).setZero();
    poses.push_back(PoseAt(Eigen::Vector3d(5, 6, 7) + center, random));
  }
  return poses;
}

Similarity3 SomeSimilarity() {
  Similarity3 b_from_a;
  b_from_a.scale = 967.36;
  b_from_a.rotation = Eigen::Quaterniond(0.3, -0.5, 0.1, 0.8).normalized();
  b_from_a.translation = {-30, 4, 1000};
  return b_from_a;
}

std::vector<Rigid3> Move(const Similarity3& b_from_a,
                         std::vector<Rigid3> poses) {
  for (Rigid3& pose : poses) pose = MovePose(b_from_a, pose);
  return poses;
}

TEST(MovePose, KeepsThePicture) {
  const Similarity3 b_from_a = SomeSimilarity();
  const Rigid3 pose = Poses(3).front();
  const Eigen::Vector3d point(0.3, -1, 2);
  const Eigen::Vector3d seen = MovePose(b_from_a, pose) * (b_from_a * point);
  EXPECT_LT((seen - b_from_a.scale * (pose * point)).norm(), 1e-9);
}

class AlignPosesExactly : public testing::TestWithParam<int> {};

TEST_P(AlignPosesExactly, UndoesASimilarity) {
  const std::vector<Rigid3> to = Poses(GetParam());
  const Similarity3 moved = SomeSimilarity();
  const auto back = AlignPoses(Move(moved, to), to);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->scale * moved.scale, 1, 1e-9);
  EXPECT_LT(back->rotation.angularDistance(moved.rotation.conjugate()), 1e-7);
  for (const Eigen::Vector3d& x :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(5, -1, 8)}) {
    EXPECT_LT((*back * (moved * x) - x).norm(), 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(SpacePlaneAndLine,
                         AlignPosesExactly,
                         testing::Values(3, 2, 1));

TEST(AlignPoses, KeepsTheScaleOfCamerasAtOnePlace) {
  const std::vector<Rigid3> to = Poses(0);
  Similarity3 moved = SomeSimilarity();
  moved.scale = 1;
  const auto back = AlignPoses(Move(moved, to), to);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->scale, 1);
  EXPECT_LT(
      (*back * (moved * Eigen::Vector3d(1, 2, 3)) - Eigen::Vector3d(1, 2, 3))
          .norm(),
      1e-9);
}

TEST(AlignPoses, LeavesNoScaleBetweenNoisyCenters) {
  std::mt19937 random(4);
  const std::vector<Rigid3> to = Poses(3);
  std::vector<Rigid3> from = Move(SomeSimilarity(), to);
  for (Rigid3& pose : from) pose.translation += 9 * RandomVector(random);
  const auto first = AlignPoses(from, to);
  ASSERT_TRUE(first);
  const auto second = AlignPoses(Move(*first, from), to);
  ASSERT_TRUE(second);
  EXPECT_NEAR(second->scale, 1, 1e-12);
  EXPECT_LT(second->rotation.angularDistance(Eigen::Quaterniond::Identity()),
            1e-7);
}

TEST(AlignPoses, RefusesContradictions) {
  const std::vector<Rigid3> poses = Poses(3);
  EXPECT_FALSE(AlignPoses({}, {}));
  EXPECT_FALSE(AlignPoses(poses, {poses.front()}));
  EXPECT_FALSE(AlignPoses(poses, Poses(0)));
  EXPECT_FALSE(AlignPoses(Poses(0), poses));
  std::vector<Rigid3> broken = poses;
  broken[2].translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(AlignPoses(broken, poses));
  std::vector<Rigid3> mirrored = poses;  // centres through the origin
  for (Rigid3& pose : mirrored) pose.translation *= -1;
  EXPECT_FALSE(AlignPoses(mirrored, poses));
}

}  // namespace
}  // namespace curvix
