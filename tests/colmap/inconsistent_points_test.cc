// SPDX-License-Identifier: BSD-3-Clause
#include "colmap/inconsistent_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cstddef>
#include <string>

#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

// Points on a line, and their exact pixels in all views.
Scene SceneWithPoints(int num_views = 4) {
  Scene scene = SceneOf(RingOfViews(num_views));
  for (int i = -5; i <= 5; ++i) {
    ScenePoint& point = scene.points.emplace_back();
    point.position = {0.1 * i, 0.05 * i, 0};
    for (std::size_t v = 0; v < scene.views.size(); ++v) {
      const View& view = scene.views[v];
      point.view_idxs.push_back(static_cast<int>(v));
      point.pixels.push_back(
          *Project(CameraOf(scene, view), view.cam_from_world, point.position));
    }
  }
  return scene;
}

TEST(RemoveInconsistentPoints, KeepsThoseThatProjectToTheirPixels) {
  Scene scene = SceneWithPoints();
  for (std::size_t i = 0; i < 4; ++i) scene.points[i].position *= 3;
  EXPECT_EQ(RemoveInconsistentPoints("sparse/0", &scene), "");
  EXPECT_THAT(scene.points, SizeIs(11));
}

TEST(RemoveInconsistentPoints, KeepsThoseWithoutPixels) {
  Scene scene = SceneWithPoints();
  for (ScenePoint& point : scene.points) {
    point.position *= 3;
    point.pixels.clear();
  }
  EXPECT_EQ(RemoveInconsistentPoints("sparse/0", &scene), "");
  EXPECT_THAT(scene.points, SizeIs(11));
}

TEST(RemoveInconsistentPoints, RemovesThoseThatWereMovedWithoutTheCameras) {
  Scene scene = SceneWithPoints();
  for (ScenePoint& point : scene.points) point.position.z() += 1;
  EXPECT_THAT(RemoveInconsistentPoints("sparse/0", &scene),
              AllOf(HasSubstr("The points of sparse/0 project"),
                    HasSubstr("is a focal length wrong?")));
  EXPECT_THAT(scene.points, SizeIs(0));

  scene = SceneWithPoints();
  for (ScenePoint& point : scene.points) point.position.x() += 1e6;
  EXPECT_NE(RemoveInconsistentPoints("sparse/0", &scene), "");
  EXPECT_THAT(scene.points, SizeIs(0));
}

TEST(RemoveInconsistentPoints, TellsTheAxesWherePointsAreBehindTheCameras) {
  Scene scene = SceneWithPoints();
  const Rigid3 turn = {Eigen::Quaterniond(0, 1, 0, 0), {0, 0, 0}};
  for (View& view : scene.views) {
    view.cam_from_world = turn * view.cam_from_world;
  }
  EXPECT_THAT(RemoveInconsistentPoints("sparse/0", &scene),
              AllOf(HasSubstr("are behind the cameras"),
                    HasSubstr("x right, y down, z forwards")));
}

// Moves every pixel by `px`, and those of the first point by as much again.
Scene SceneWithErrors(double px, int num_views) {
  Scene scene = SceneWithPoints(num_views);
  for (ScenePoint& point : scene.points) {
    for (auto& pixel : point.pixels) pixel.x() += px;
  }
  for (auto& pixel : scene.points[0].pixels) pixel.x() += px;
  return scene;
}

TEST(LargeErrorsNote, SaysByHowMuchPointsAreOff) {
  EXPECT_EQ(LargeErrorsNote(SceneWithErrors(1.9, 10)), "");
  EXPECT_THAT(LargeErrorsNote(SceneWithErrors(3.1, 10)),
              HasSubstr("project 3.1 px from their pixels (median)"));
  EXPECT_EQ(LargeErrorsNote(SceneWithErrors(3.1, 4)), "") << "too few";
  EXPECT_EQ(LargeErrorsNote({}), "");
}

TEST(LargeErrorsNote, TellsOfAFocalLengthThatIsOff) {
  Scene scene = SceneWithPoints(10);
  EXPECT_EQ(LargeErrorsNote(scene), "");
  for (Camera& camera : scene.cameras) camera.params[0] *= 1.2;
  EXPECT_NE(LargeErrorsNote(scene), "");
}

}  // namespace
}  // namespace curvix
