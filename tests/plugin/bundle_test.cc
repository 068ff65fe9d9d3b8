// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/poses/bundle.h"

#include <cmath>
#include <limits>

#include "base/median.h"
#include "gtest/gtest.h"
#include "tests/plugin/posed_points.h"

namespace curvix {
namespace {

TEST(BundleFromModel, TakesEveryObservationOfAGoodModel) {
  const ColmapModel model = PosedPoints({});
  const Bundle bundle = BundleFromModel(model);
  ASSERT_EQ(bundle.views.size(), model.images.size());
  std::size_t num_observations = 0;
  for (const BundlePoint& point : bundle.points) {
    num_observations += point.observations.size();
    EXPECT_EQ(point.position, model.points[point.point_idx].position);
    for (const double error : ReprojectionErrors(bundle, point)) {
      EXPECT_LT(error, 6 * 0.3);
    }
  }
  std::size_t expected = 0;
  for (const ColmapPoint3D& point : model.points) {
    if (point.track.size() >= 2) expected += point.track.size();
  }
  EXPECT_EQ(num_observations, expected);
}

TEST(BundleFromModel, LeavesOutWhatDoesNotExistOrIsNotSeen) {
  ColmapModel model = PosedPoints({});
  const std::size_t before = BundleFromModel(model).points.size();
  model.points[0].track = {{999, 0}, {10, 1u << 30}};         // no such image
  model.points[1].position = {0, 0, -50};                     // behind some
  model.points[2].position.setConstant(std::nan(""));         // nowhere
  model.points[3].track.resize(1);                            // one view
  model.points[4].track.assign(5, model.points[4].track[0]);  // the same
  const Bundle bundle = BundleFromModel(model);
  EXPECT_LE(bundle.points.size(), before - 4);
  for (const BundlePoint& point : bundle.points) {
    EXPECT_TRUE(point.point_idx > 4 || point.point_idx == 1);
    EXPECT_GE(point.observations.size(), 2u);
    for (const double error : ReprojectionErrors(bundle, point)) {
      EXPECT_TRUE(std::isfinite(error));
    }
  }
}

TEST(BundleFromModel, LeavesOutViewsWithFewObservations) {
  ColmapModel model = PosedPoints({});
  const std::uint32_t lonely = model.images[3].image_id;
  for (std::size_t i = 5; i < model.points.size(); ++i) {
    std::erase_if(model.points[i].track,
                  [&](const auto& e) { return e.image_id == lonely; });
  }
  const Bundle bundle = BundleFromModel(model);
  EXPECT_EQ(bundle.views.size(), model.images.size() - 1);
  for (const BundleView& view : bundle.views) EXPECT_NE(view.image_idx, 3u);
}

TEST(BundleFromModel, OfPosesOnlyIsEmpty) {
  ColmapModel model = PosedPoints({});
  model.points.clear();
  const Bundle bundle = BundleFromModel(model);
  EXPECT_TRUE(bundle.points.empty());
  EXPECT_TRUE(bundle.views.empty());
}

TEST(ModelWithBundle, ChangesNothingElse) {
  const ColmapModel model = PosedPoints({});
  Bundle bundle = BundleFromModel(model);
  bundle.views[2].cam_from_world.translation.x() += 1;
  bundle.points[5].position.y() += 1;
  const ColmapModel changed = ModelWithBundle(model, bundle);
  EXPECT_EQ(PosesOf(changed)[2].translation.x(),
            PosesOf(model)[2].translation.x() + 1);
  EXPECT_EQ(PosesOf(changed)[3].translation, PosesOf(model)[3].translation);
  EXPECT_EQ(changed.points[bundle.points[5].point_idx].position,
            bundle.points[5].position);
  EXPECT_EQ(changed.points.size(), model.points.size());
  EXPECT_EQ(changed.images[4].points2D.size(), model.images[4].points2D.size());
}

TEST(FitPoint, FindsThePointInSpiteOfAnOutlier) {
  PosedPointsOptions options;
  options.noise_px = 0;
  options.camera = {
      CameraModel::kOpenCV, 640, 480, {500, 510, 320, 240, -0.1, 0.02, 0, 0}};
  Bundle bundle = BundleFromModel(PosedPoints(options));
  BundlePoint point = bundle.points.front();
  ASSERT_GE(point.observations.size(), 4u);
  const Eigen::Vector3d truth = point.position;
  point.position += Eigen::Vector3d(0.01, -0.02, 0.01);
  EXPECT_LT((FitPoint(bundle, point) - truth).norm(), 1e-6);
  point.observations.front().pixel.x() += 100;
  EXPECT_LT((FitPoint(bundle, point) - truth).norm(), 1e-3);
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
