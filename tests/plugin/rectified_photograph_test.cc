// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/rectified_photograph.h"

#include <curvix/curves.h>
#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

// A camera with a lens that distorts, which looks at a point of the plane y
// = 2.
Scene Oblique(const Vector3d& center) {
  Scene scene = ToScene({LookAt(center, {0, 2, 0})});
  scene.cameras.front() = {
      CameraModel::kSimpleRadial, 640, 480, {500, 320, 240, -0.08}};
  return scene;
}

// White, with a black rectangle from (-1, -0.5) to (0.5, 1) in the plane.
cv::Mat PhotographOf(const Scene& scene) {
  const Camera& camera = scene.cameras.front();
  const Rigid3 world_from_cam = scene.views.front().cam_from_world.Inverse();
  cv::Mat image(camera.height, camera.width, CV_8UC3);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const auto ideal = IdealFromImage(camera, {x + 0.5, y + 0.5});
      const Vector3d ray =
          world_from_cam.rotation * ideal->homogeneous().eval();
      const Vector3d& center = world_from_cam.translation;
      const Vector3d at = center + (2 - center.y()) / ray.y() * ray;
      const bool is_black =
          at.x() > -1 && at.x() < 0.5 && at.z() > -0.5 && at.z() < 1;
      image.at<cv::Vec3b>(y, x) =
          is_black ? cv::Vec3b(0, 0, 0) : cv::Vec3b(255, 255, 255);
    }
  }
  return image;
}

TEST(RectifiedPhotograph, ARectangleOfThePlaneIsWhereItIs) {
  const TemporaryFolder folder;
  Scene scene = Oblique({-2, -2.5, 0.7});
  View& view = scene.views.front();
  view.image_path = folder.path() / "photograph.png";
  ASSERT_TRUE(cv::imwrite(view.image_path.string(), PhotographOf(scene)));
  const DrawingPlane plane = *AxisPlane("xz");
  const PictureArea area{
      plane, 2, {Eigen::Vector2d(-1.5, -1), Eigen::Vector2d(1, 1.5)}};
  const auto photograph = Rectify(scene, 0, area, 2);
  ASSERT_TRUE(photograph.ok()) << photograph.status().message();
  const SheetPicture& place = photograph->place;
  const cv::Mat flat = cv::imdecode(
      std::vector<char>(photograph->jpeg.begin(), photograph->jpeg.end()),
      cv::IMREAD_GRAYSCALE);
  ASSERT_EQ(flat.cols, place.size.x());
  ASSERT_EQ(flat.rows, place.size.y());
  int num_wrong = 0;
  for (int y = 0; y < flat.rows; ++y) {
    for (int x = 0; x < flat.cols; ++x) {
      const Eigen::Vector2d at =
          place.corner +
          place.pixel * Eigen::Vector2d(x + 0.5, flat.rows - y - 0.5);
      const Eigen::AlignedBox2d black(Eigen::Vector2d(-1, -0.5),
                                      Eigen::Vector2d(0.5, 1));
      const double inside = black.contains(at)
                                ? std::min((at - black.min()).minCoeff(),
                                           (black.max() - at).minCoeff())
                                : -black.exteriorDistance(at);
      // Two pixels beside its outline, all is black or white.
      if (std::abs(inside) < 2 * place.pixel) continue;
      num_wrong += (flat.at<unsigned char>(y, x) < 128) != (inside > 0);
    }
  }
  EXPECT_EQ(num_wrong, 0);
  EXPECT_EQ(BestViewOf(scene, area), 0u);
}

TEST(RectifiedPhotograph, TheViewThatLooksStraightAtThePlaneIsBest) {
  Scene scene = Oblique({-4, -1, 0});
  for (const Vector3d& center : {Vector3d(0, -4, 0), Vector3d(0, 8, 0)}) {
    scene.views.push_back(Oblique(center).views.front());
  }
  const DrawingPlane plane = *AxisPlane("xz");
  const PictureArea area{
      plane, 2, {Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 1)}};
  EXPECT_EQ(BestViewOf(scene, area), 1u);
  const DrawingPlane behind = FromBehind(plane);
  EXPECT_EQ(BestViewOf(scene, {behind, 2, area.bounds}), 2u);
  scene.views.resize(2);
  EXPECT_FALSE(BestViewOf(scene, {behind, 2, area.bounds}).has_value());
}

TEST(RectifiedPhotograph, ViewsFromBehindShowNoFront) {
  Scene scene = Oblique({0, -4, 0});
  const DrawingPlane plane = *AxisPlane("xz");
  const DrawingPlane behind = FromBehind(plane);
  const Eigen::AlignedBox2d bounds(Eigen::Vector2d(-1, -1),
                                   Eigen::Vector2d(1, 1));
  const View& view = scene.views.front();
  EXPECT_TRUE(ShowsFront(scene, view, {plane, 2, bounds}));
  EXPECT_FALSE(ShowsFront(scene, view, {behind, 2, bounds}));
  const Eigen::Vector2d aside(100, 0);
  EXPECT_FALSE(ShowsFront(scene, view, {plane, 2, bounds.translated(aside)}));
}

TEST(RectifiedPhotograph, SaysWhichImageIsMissing) {
  Scene scene = Oblique({0, -4, 0});
  scene.views.front().image_path = "nowhere.png";
  const DrawingPlane plane = *AxisPlane("xz");
  const auto photograph =
      Rectify(scene,
              0,
              {plane, 2, {Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 1)}},
              1);
  ASSERT_FALSE(photograph.ok());
  EXPECT_NE(photograph.status().message().find("nowhere.png"),
            std::string::npos);
}

}  // namespace
}  // namespace curvix
