// SPDX-License-Identifier: BSD-3-Clause

#include "plugin/poses/curve_poses.h"
#include "geometry/similarity.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/plugin/posed_points.h"
#include "tests/support/wire_scene.h"

namespace curvix {
namespace {

using testing::HasSubstr;

// A model of the views of `scene`, without points.
ColmapModel ModelOf(const Scene& scene) {
  ColmapModel model;
  for (const View& view : scene.views) {
    const auto camera_idx = static_cast<std::size_t>(view.camera_idx);
    const auto camera_id = static_cast<std::uint32_t>(camera_idx + 1);
    model.cameras.push_back({camera_id, scene.cameras[camera_idx]});
    ColmapImage& image = model.images.emplace_back();
    image.image_id = view.image_id;
    image.camera_id = camera_id;
    image.name = view.name;
    image.cam_from_world = view.cam_from_world;
  }
  return model;
}

class CurvePosesOfAModel : public testing::Test {
 protected:
  CurvePosesOfAModel()
      : wires_(MakeWireScene(CubeAndCircle(), 12)),
        model_(ModelOf(wires_.scene)) {
    DisturbPoses(1, 3, &model_);
    scene_ = SceneFromColmapModel(model_, "images");
  }

  CurvePoseRefinement RefineModel() const {
    const auto poses =
        RefinePosesWithCurves(scene_, wires_.edge_maps, Options());
    return ModelWithCurvePoses(model_, scene_, *poses);
  }

  WireScene wires_;
  ColmapModel model_;
  Scene scene_;
};

TEST_F(CurvePosesOfAModel, AreThoseOfTheInputsWorld) {
  const CurvePoseRefinement refined = RefineModel();
  ASSERT_TRUE(refined.model) << refined.record.poses.reason;
  const auto left = AlignPoses(PosesOf(*refined.model), PosesOf(model_));
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->scale, 1, 1e-2);
  EXPECT_TRUE(refined.record.cameras.empty());
  EXPECT_THAT(CurvePosesText(refined.record), HasSubstr("12 views, "));
}

TEST(CurvePosesText, HasTheErrorsOfPointsIfNoCurveWasHeldOut) {
  CurvePoseRecord record;
  record.poses.accepted = true;
  record.poses.num_views_moved = 4;
  record.poses.points_before.median_px = 0.5;
  record.poses.points_after.median_px = 0.25;
  record.poses.max_shift_px = 1;
  EXPECT_EQ(CurvePosesText(record),
            "4 views, 0.500 to 0.250 px, shifts up to 1.00 px");
  record.poses.num_check_observations = 1;
  record.poses.before.median_px = 0.125;
  EXPECT_THAT(CurvePosesText(record), HasSubstr("0.125 to 0.000 px"));
}

TEST(CurvePosesRefusal, HasTheReason) {
  CurvePoseRecord record;
  record.poses.reason = "may be chance";
  EXPECT_EQ(CurvePosesRefusal(record), "");
  record.poses.num_views_moved = 4;
  EXPECT_EQ(CurvePosesRefusal(record),
            "Refinement with curves is refused: may be chance.");
  record.poses.accepted = true;
  EXPECT_EQ(CurvePosesRefusal(record), "");
}

TEST_F(CurvePosesOfAModel, LeaveOutViewsThatAreMissing) {
  scene_ = SceneFromColmapModel(model_, "images", {scene_.views[5].name});
  wires_.edge_maps.erase(wires_.edge_maps.begin() + 5);
  const CurvePoseRefinement refined = RefineModel();
  ASSERT_TRUE(refined.model) << refined.record.poses.reason;
  EXPECT_EQ(refined.model->images[5].cam_from_world.translation,
            model_.images[5].cam_from_world.translation);
}

// A shared camera changes; the pose of the image that nobody has seen was made
// for the old one.
TEST_F(CurvePosesOfAModel, LeaveTheCameraOfViewsThatAreMissing) {
  for (ColmapImage& image : model_.images) image.camera_id = 1;
  model_.cameras.resize(1);
  const Camera before = model_.cameras[0].camera;
  scene_ = SceneFromColmapModel(model_, "images", {scene_.views[5].name});
  CurvePoses poses;
  poses.accepted = true;
  for (const View& view : scene_.views) {
    poses.cam_from_world.push_back(view.cam_from_world);
  }
  poses.cameras = {before};
  poses.cameras[0].params[0] *= 1.01;
  const auto refined = ModelWithCurvePoses(model_, scene_, poses);
  ASSERT_TRUE(refined.model);
  ASSERT_EQ(refined.model->cameras.size(), 2u);
  EXPECT_EQ(refined.model->cameras[0].camera, poses.cameras[0]);
  EXPECT_EQ(refined.model->cameras[1].camera_id, 2u);
  EXPECT_EQ(refined.model->cameras[1].camera, before);
  for (std::size_t i = 0; i < model_.images.size(); ++i) {
    EXPECT_EQ(refined.model->images[i].camera_id, i == 5 ? 2u : 1u);
  }

  // Without such an image there is no such camera.
  scene_ = SceneFromColmapModel(model_, "images");
  poses.cam_from_world.push_back(poses.cam_from_world.back());
  EXPECT_EQ(ModelWithCurvePoses(model_, scene_, poses).model->cameras.size(),
            1u);
}

}  // namespace
}  // namespace curvix
