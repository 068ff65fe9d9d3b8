// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/pose_judgement.h"

#include <vector>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/poses/adjustable_scene.h"
#include "tests/plugin/posed_points.h"

namespace curvix {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// The scene with the first `num_bad` views off by about `px`, the others by
// `rest_px`.
Scene Disturbed(const ColmapModel& model,
                std::size_t num_bad,
                double px,
                double rest_px) {
  ColmapModel bad = model, rest = model;
  DisturbPoses(px, 5, &bad);
  DisturbPoses(rest_px, 6, &rest);
  const Scene from = AdjustableScene(bad);
  Scene scene = AdjustableScene(rest);
  for (std::size_t i = 0; i < num_bad; ++i) {
    scene.views[i].cam_from_world = from.views[i].cam_from_world;
  }
  return scene;
}

std::string Reason(const Scene& before, const Scene& after, Scene seen) {
  const PoseJudgement judgement =
      JudgePoses(before, after, TakeCheckPoints(&seen));
  EXPECT_FALSE(judgement.accepted);
  return judgement.reason;
}

TEST(JudgePoses, SaysWhichErrorDoesNotFall) {
  const ColmapModel model = PosedPoints({});
  const Scene truth = AdjustableScene(model);
  const Scene one_is_off = Disturbed(model, 1, 16, 0);
  const Scene all_are_off = Disturbed(model, 0, 0, 0.5);
  EXPECT_THAT(
      Reason(one_is_off, all_are_off, truth),
      AllOf(HasSubstr("median error of points that were held out does not "
                      "fall"),
            HasSubstr("though the mean does"),
            Not(HasSubstr("nothing to gain"))));
  EXPECT_THAT(Reason(truth, all_are_off, truth),
              HasSubstr("nothing to gain: the mean error"));
}

TEST(PosesFit, AsksEveryView) {
  PosedPointsOptions options;
  options.noise_px = 0.03;
  Scene scene = AdjustableScene(PosedPoints(options));
  const std::vector<ScenePoint> check_points = TakeCheckPoints(&scene);
  EXPECT_TRUE(PosesFit(scene, check_points));
  EXPECT_FALSE(PosesFit(scene, {}));
  std::vector<ScenePoint> without_first = check_points;
  for (ScenePoint& point : without_first) {
    const std::vector<int> seen_by = point.view_idxs;
    KeepObservations([&](std::size_t i) { return seen_by[i] != 0; }, &point);
  }
  EXPECT_FALSE(PosesFit(scene, without_first));
}

}  // namespace
}  // namespace curvix
