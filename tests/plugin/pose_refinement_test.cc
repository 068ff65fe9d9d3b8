// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/pose_refinement.h"

#include <curvix/scene.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "geometry/similarity.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/plugin/fake_colmap.h"
#include "tests/plugin/posed_points.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(RefinePoses, SkipsModelsWithFewPoints) {
  for (const std::size_t num_points : {0u, 5u, 90u}) {
    PosedPointsOptions options;
    options.num_points = num_points;
    ColmapModel model = PosedPoints(options);
    DisturbPoses(1, 5, &model);
    const PoseRefinement result = Refine(model, {});
    EXPECT_FALSE(result.model);
    EXPECT_EQ(result.record.refiner, "none");
    EXPECT_THAT(result.notes, ElementsAre(HasSubstr("at least 100")));
  }
}

TEST(RefinePoses, DoesNothingIfNotAskedTo) {
  PoseRefinementSettings settings;
  settings.refiner = "none";
  ColmapModel model = PosedPoints({});
  DisturbPoses(1, 5, &model);
  const PoseRefinement result = Refine(model, settings);
  EXPECT_FALSE(result.model);
  EXPECT_THAT(result.notes, IsEmpty());
}

TEST_F(FakeColmap, GetsStableOptionsAndAModelInAPrivateFolder) {
  Run("echo \"$@\"; ls \"$3\"; stat -c %a \"$3/..\"");
  EXPECT_THAT(Log(),
              AllOf(HasSubstr("--BundleAdjustment.refine_focal_length 0 "
                              "--BundleAdjustment.refine_principal_point 0 "
                              "--BundleAdjustment.refine_extra_params 0\n"),
                    HasSubstr("cameras.bin\nimages.bin\npoints3D.bin\n700\n")));
  const ColmapModel written = Written();
  EXPECT_EQ(written.images.size(), model_.images.size());
  EXPECT_LT(written.points.size(), model_.points.size());
}

TEST_F(FakeColmap, StopsWhenTheCostHardlyFalls) {
  for (const std::string name :
       {"--BundleAdjustment.function_tolerance",
        "--BundleAdjustmentCeres.function_tolerance"}) {
    Run("echo \"$@\"", "echo '  " + name + " arg (=0)'");
    EXPECT_THAT(Log(),
                HasSubstr("--BundleAdjustment.refine_extra_params 0 " + name +
                          " 0.000001\n"));
  }
}

TEST_F(FakeColmap, MissingIsToldAndPosesAreKept) {
  settings_.colmap_path = folder_.path() / "no colmap";
  const PoseRefinement result = Refine(model_, settings_);
  EXPECT_FALSE(result.model);
  EXPECT_EQ(result.record.refiner, "none");
  EXPECT_THAT(result.record.reason, HasSubstr("no colmap"));
  EXPECT_THAT(result.notes,
              ElementsAre(AllOf(HasSubstr("WARNING"),
                                HasSubstr("no colmap"),
                                HasSubstr("apt install colmap"),
                                HasSubstr("--colmap_path"),
                                HasSubstr("still refined"),
                                HasSubstr("--refine_poses_with_curves"))));
  settings_.refine_poses_with_curves = false;
  EXPECT_THAT(Refine(model_, settings_).notes,
              ElementsAre(AllOf(HasSubstr("apt install colmap"),
                                HasSubstr("used as they are"),
                                Not(HasSubstr("still refined")))));
}

TEST_F(FakeColmap, StopsWhenAskedTo) {
  settings_.refiner_timeout_s = 60;
  const fs::path script =
      folder_.Write("bin/colmap", "#!/bin/sh\nexec sleep 600\n");
  fs::permissions(script, fs::perms::owner_all);
  settings_.colmap_path = script;
  for (const int last_call : {1, 2, 5}) {
    int num_calls = 0;
    const auto result =
        RefinePoses(model_, settings_, {}, [&](const std::string&, int, int) {
          return ++num_calls < last_call;
        });
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.status().code(), StatusCode::kCancelled);
  }
}

TEST_F(FakeColmap, ATemporaryFolderThatIsNotThereIsTold) {
  const char* const set = std::getenv("TMPDIR");
  const std::string before = set == nullptr ? "" : set;
  setenv("TMPDIR", "/no/such/folder", 1);
  const PoseRefinement result = Run("exit 0");
  set == nullptr ? unsetenv("TMPDIR") : setenv("TMPDIR", before.c_str(), 1);
  ExpectKept(result, "TMPDIR is not a folder");
}

TEST_F(FakeColmap, HangingIsEnded) {
  ExpectKept(Run("sleep 600"), "not done after 1.0 s");
}

TEST_F(FakeColmap, HangingInHelpIsEnded) {
  ExpectKept(Run("exit 0", "sleep 600"), "not done after 1.0 s");
}

TEST_F(FakeColmap, CrashingIsTold) {
  ExpectKept(Run("echo Check failed; kill -ABRT $$"), "signal 6");
  ExpectKept(Run("exit 134"), "exit code 134");
  ExpectKept(Run("exit 1"), "see log");
}

TEST_F(FakeColmap, CameraModelsThatItDoesNotKnowAreNamed) {
  ColmapCamera& camera = model_.cameras.front();
  camera.camera.model = CameraModel::kEucm;
  camera.camera.params = {500, 500, 320, 240, 0.5, 1};
  const std::string sentence = "it does not know the camera model EUCM";
  ExpectKept(Run("echo 'camera.cc:52] Check failed: "
                 "ExistsCameraModelWithId(model_id) '; kill -ABRT $$"),
             sentence);
  ExpectKept(Run("echo '  what():  Camera model does not exist' >&2; exit 134"),
             sentence);
}

TEST_F(FakeColmap, WritingNothingIsTold) {
  ExpectKept(Run("exit 0"), "it wrote no model;");
}

TEST_F(FakeColmap, WritingNonsenseIsTold) {
  ExpectKept(Run("for f in cameras images points3D; do head -c 5000 "
                 "/dev/urandom > \"$5\"/$f.bin; done"),
             "it wrote a model that cannot be read: images.bin");
}

TEST_F(FakeColmap, WritingAnotherModelIsTold) {
  ColmapModel fewer = Written();
  fewer.images.pop_back();
  for (ColmapPoint3D& point : fewer.points) point.track.clear();
  ExpectKept(Run(Copy(fewer, "fewer")), "other images or cameras");
  ColmapModel renamed = Written();
  std::swap(renamed.images[0].name, renamed.images[1].name);
  ExpectKept(Run(Copy(renamed, "renamed")), "other images or cameras");
}

TEST_F(FakeColmap, WritingPosesThatAreNoBetterChangesNothing) {
  ExpectKept(Run("cp \"$3\"/*.bin \"$5\""), "nothing to gain", "is refused: ");
}

TEST_F(FakeColmap, WorsePosesThanGoodOnesAreRefused) {
  model_ = PosedPoints({});
  ColmapModel disturbed = model_;
  DisturbPoses(1, 5, &disturbed);
  ExpectKept(Solve(disturbed), "nothing to gain", "is refused: ");
}

TEST_F(FakeColmap, IsNotRunOnPointsThatFit) {
  PosedPointsOptions options;
  options.noise_px = 0.03;
  model_ = PosedPoints(options);
  const fs::path mark = folder_.path() / "ran";
  const PoseRefinement result = Run("touch '" + mark.string() + "'");
  EXPECT_FALSE(fs::exists(mark));
  EXPECT_FALSE(result.model);
  EXPECT_EQ(result.record.refiner, "none");
  EXPECT_THAT(
      result.notes,
      ElementsAre(HasSubstr("the points are where the poses put them")));
  DisturbPoses(0.1, 5, &model_);
  EXPECT_EQ(Run("touch '" + mark.string() + "'").record.refiner, "colmap");
  EXPECT_TRUE(fs::exists(mark));
}

TEST_F(FakeColmap, LowersTheErrorsOfPointsThatWereHeldOut) {
  const PoseRefinement result = Solve(PosedPoints({}));
  ASSERT_TRUE(result.record.judgement);
  const PoseJudgement& judgement = *result.record.judgement;
  EXPECT_TRUE(result.record.accepted);
  EXPECT_GT(judgement.before.mean_px, 0.6);
  EXPECT_LT(judgement.after.mean_px, 0.4);  // noise: 0.3 px an axis
  EXPECT_GE(judgement.num_check_points, 40u);
  EXPECT_LT(judgement.median_shift_px, 2);
  EXPECT_LT(judgement.max_shift_px, 5);
  EXPECT_THAT(result.notes, IsEmpty());
  for (const ColmapPoint3D& point : result.model->points) {
    EXPECT_TRUE(point.track.size() < 2 || point.error < 2) << point.error;
  }
}

TEST_F(FakeColmap, IsGivenNoOutliers) {
  std::size_t num_observations = 0;
  for (ColmapImage& image : model_.images) {
    num_observations += image.points2D.size();
    for (std::size_t i = 0; i < image.points2D.size(); i += 10) {
      image.points2D[i].x += 20;
    }
  }
  EXPECT_TRUE(Solve(PosedPoints({})).model);
  const ColmapModel written = Written();
  std::size_t num_written = 0;
  for (const ColmapPoint3D& point : written.points) {
    for (const ColmapTrackElement& seen : point.track) {
      const ColmapImage& image = written.images[seen.image_id - 1];
      const auto pixel = Project(
          written.cameras[0].camera, image.cam_from_world, point.position);
      const ColmapPoint2D& point2D = image.points2D[seen.point2D_idx];
      ASSERT_TRUE(pixel);
      EXPECT_LT(std::hypot(pixel->x() - point2D.x, pixel->y() - point2D.y), 10);
      ++num_written;
    }
  }
  // All others of the nine points in ten that are not held out.
  EXPECT_GT(num_written, num_observations * 3 / 4);
}

TEST_F(FakeColmap, IsGivenTheObservationsOfAViewThatIsFarOff) {
  Rigid3& pose = model_.images[0].cam_from_world;
  pose.translation.x() += 0.02 * pose.translation.norm();
  const ColmapModel written = Written();
  std::vector<std::size_t> counts(written.images.size());
  for (const ColmapPoint3D& point : written.points) {
    for (const ColmapTrackElement& seen : point.track) {
      ++counts[seen.image_id - 1];
    }
  }
  for (const std::size_t count : counts) {
    EXPECT_GT(2 * count, std::ranges::max(counts));
  }
}

TEST_F(FakeColmap, SamePosesGiveTheSameBytes) {
  const PoseRefinement a = Solve(PosedPoints({}));
  const PoseRefinement b = Solve(PosedPoints({}));
  ASSERT_TRUE(a.model && b.model);
  for (std::size_t i = 0; i < a.model->images.size(); ++i) {
    EXPECT_EQ(PosesOf(*a.model)[i].translation,
              PosesOf(*b.model)[i].translation);
    EXPECT_EQ(PosesOf(*a.model)[i].rotation.coeffs(),
              PosesOf(*b.model)[i].rotation.coeffs());
  }
}

TEST_F(FakeColmap, MovingACameraImplausiblyIsRefused) {
  ColmapModel moved = WrittenWithPosesOf(PosedPoints({}));
  EXPECT_TRUE(Run(Copy(moved, "good")).model);
  moved.images[2].cam_from_world.translation.x() += 1;
  ExpectKept(Run(Copy(moved, "moved")), "px", "is refused: ");
}

TEST_F(FakeColmap, MovingAndScalingTheWorldIsUndone) {
  Similarity3 moved;
  moved.scale = 1 / 967.36;
  moved.rotation = Eigen::Quaterniond(0.3, -0.5, 0.1, 0.8).normalized();
  moved.translation = {-30, 4, 1000};
  const ColmapModel truth = PosedPoints({});
  ColmapModel model = WrittenWithPosesOf(truth);
  for (ColmapImage& image : model.images) {
    image.cam_from_world = MovePose(moved, image.cam_from_world);
  }
  for (ColmapPoint3D& point : model.points) {
    point.position = moved * point.position;
  }
  const PoseRefinement result = Run(Copy(model, "scaled"));
  ASSERT_TRUE(result.model) << result.record.reason;
  EXPECT_NEAR(result.record.scale_removed, moved.scale, 1e-3 * moved.scale);
  EXPECT_EQ(result.record.colmap_version, "3.8");
  const auto left = AlignPoses(PosesOf(*result.model), PosesOf(model_));
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->scale, 1, 1e-9);
  EXPECT_LT(left->translation.norm(), 1e-9);
  EXPECT_LT(left->rotation.angularDistance(Eigen::Quaterniond::Identity()),
            1e-7);
  EXPECT_LT(MedianShift(AlignedTo(truth, *result.model), truth), 1e-3);
}

TEST_F(FakeColmap, GetsAWorldOfMapCoordinatesAboutTheOrigin) {
  const Similarity3 to_map = {.translation = {5e5, 5.4e6, 100}};
  for (ColmapImage& image : model_.images) {
    image.cam_from_world = MovePose(to_map, image.cam_from_world);
  }
  for (ColmapPoint3D& point : model_.points) {
    point.position = to_map * point.position;
  }
  const ColmapModel written = Written();
  for (const Rigid3& pose : PosesOf(written)) {
    EXPECT_LT(pose.Inverse().translation.norm(), 10);
  }
  for (const ColmapPoint3D& point : written.points) {
    EXPECT_LT(point.position.norm(), 10);
  }
}

}  // namespace
}  // namespace curvix
