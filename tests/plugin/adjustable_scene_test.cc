// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/adjustable_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/median.h"
#include "colmap/inconsistent_points.h"
#include "gtest/gtest.h"
#include "tests/plugin/posed_points.h"

namespace curvix {
namespace {

const ColmapPoint3D& PointOf(const ColmapModel& model,
                             std::uint64_t point3D_id) {
  return *std::find_if(
      model.points.begin(), model.points.end(), [&](const auto& point) {
        return point.point3D_id == point3D_id;
      });
}

TEST(AdjustableScene, TakesEveryObservationOfAGoodModel) {
  const ColmapModel model = PosedPoints({});
  const Scene scene = AdjustableScene(model);
  ASSERT_EQ(scene.views.size(), model.images.size());
  std::size_t num_observations = 0;
  for (const ScenePoint& point : scene.points) {
    num_observations += point.pixels.size();
    EXPECT_EQ(point.position, PointOf(model, point.point3D_id).position);
    for (const double error : ReprojectionErrors(scene, point)) {
      EXPECT_LT(error, 6 * 0.3);
    }
  }
  std::size_t expected = 0;
  for (const ColmapPoint3D& point : model.points) {
    if (point.track.size() >= 2) expected += point.track.size();
  }
  EXPECT_EQ(num_observations, expected);
}

TEST(AdjustableScene, LeavesOutWhatDoesNotExistOrIsNotSeen) {
  ColmapModel model = PosedPoints({});
  const std::size_t before = AdjustableScene(model).points.size();
  model.points[0].track = {{999, 0}, {10, 1u << 30}};         // no such image
  model.points[1].position = {0, 0, -50};                     // behind some
  model.points[2].position.setConstant(std::nan(""));         // nowhere
  model.points[3].track.resize(1);                            // one view
  model.points[4].track.assign(5, model.points[4].track[0]);  // the same
  const Scene scene = AdjustableScene(model);
  EXPECT_LE(scene.points.size(), before - 4);
  for (const ScenePoint& point : scene.points) {
    EXPECT_TRUE(point.point3D_id > model.points[4].point3D_id ||
                point.point3D_id == model.points[1].point3D_id);
    EXPECT_GE(point.pixels.size(), 2u);
    for (const double error : ReprojectionErrors(scene, point)) {
      EXPECT_TRUE(std::isfinite(error));
    }
  }
}

TEST(AdjustableScene, LeavesOutViewsWithFewObservations) {
  ColmapModel model = PosedPoints({});
  const std::uint32_t lonely = model.images[3].image_id;
  for (std::size_t i = 5; i < model.points.size(); ++i) {
    std::erase_if(model.points[i].track,
                  [&](const auto& e) { return e.image_id == lonely; });
  }
  const Scene scene = AdjustableScene(model);
  EXPECT_EQ(scene.views.size(), model.images.size() - 1);
  for (const View& view : scene.views) EXPECT_NE(view.image_id, lonely);
}

TEST(AdjustableScene, OfPosesOnlyIsEmpty) {
  ColmapModel model = PosedPoints({});
  model.points.clear();
  const Scene scene = AdjustableScene(model);
  EXPECT_TRUE(scene.points.empty());
  EXPECT_TRUE(scene.views.empty());
}

TEST(ModelWithScene, ChangesNothingElse) {
  const ColmapModel model = PosedPoints({});
  Scene scene = AdjustableScene(model);
  View& moved = scene.views[2];
  moved.cam_from_world.translation.x() += 1;
  ScenePoint& point = scene.points[5];
  point.position.y() += 1;
  const ColmapModel changed = ModelWithScene(model, scene);
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    const bool is_moved = model.images[i].image_id == moved.image_id;
    EXPECT_EQ(PosesOf(changed)[i].translation.x(),
              PosesOf(model)[i].translation.x() + is_moved);
    EXPECT_EQ(changed.images[i].name, model.images[i].name);
    EXPECT_EQ(changed.images[i].points2D.size(),
              model.images[i].points2D.size());
  }
  ASSERT_EQ(changed.points.size(), model.points.size());
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const bool is_moved = model.points[i].point3D_id == point.point3D_id;
    EXPECT_EQ(changed.points[i].position.y(),
              model.points[i].position.y() + is_moved);
  }
}

TEST(FitPoint, FindsThePointInSpiteOfAnOutlier) {
  PosedPointsOptions options;
  options.noise_px = 0;
  options.camera = {
      CameraModel::kOpenCV, 640, 480, {500, 510, 320, 240, -0.1, 0.02, 0, 0}};
  const Scene scene = AdjustableScene(PosedPoints(options));
  ScenePoint point = scene.points.front();
  ASSERT_GE(point.pixels.size(), 4u);
  const Eigen::Vector3d truth = point.position;
  point.position += Eigen::Vector3d(0.01, -0.02, 0.01);
  EXPECT_LT((FitPoint(scene, point) - truth).norm(), 1e-6);
  point.pixels.front().x() += 100;
  EXPECT_LT((FitPoint(scene, point) - truth).norm(), 1e-3);
}

TEST(Project, SeesNothingBehindTheCamera) {
  const Camera camera{CameraModel::kPinhole, 640, 480, {500, 510, 320, 240}};
  EXPECT_FALSE(Project(camera, {}, {0, 0, -1}));
  EXPECT_FALSE(Project(camera, {}, {0, 0, 0}));
  EXPECT_FALSE(Project(camera, {}, Eigen::Vector3d::Constant(std::nan(""))));
  EXPECT_EQ(Project(camera, {}, {1, 1, 2})->x(), 320 + 250);
}

TEST(MedianOrNan, IsTheMiddle) {
  EXPECT_EQ(MedianOrNan({3, 1, 2}), 2);
  EXPECT_EQ(MedianOrNan({4, 1, 3, 2}), 2.5);
  EXPECT_TRUE(std::isnan(MedianOrNan({})));
}

}  // namespace
}  // namespace curvix
