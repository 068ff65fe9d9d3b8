// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/align/find_markers.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "plugin/align/marker_detector.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_views.h"

#ifdef CURVIX_HAS_ARUCO
#if CV_VERSION_MAJOR * 100 + CV_VERSION_MINOR >= 407
#include <opencv2/objdetect/aruco_detector.hpp>
#else
#include <opencv2/aruco.hpp>
#endif

namespace curvix {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kSide = 0.35;  // of a marker, world units

// A marker of 6 x 6 cells within a white margin of one cell.
constexpr int kCellPx = 30;

cv::Mat MarkerImage(int id) {
  const auto dictionary =
      cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
  cv::Mat marker, framed;
#if CV_VERSION_MAJOR * 100 + CV_VERSION_MINOR >= 407
  cv::aruco::generateImageMarker(dictionary, id, 6 * kCellPx, marker);
#else
  cv::aruco::drawMarker(dictionary, id, 6 * kCellPx, marker);
#endif
  cv::copyMakeBorder(marker,
                     framed,
                     kCellPx,
                     kCellPx,
                     kCellPx,
                     kCellPx,
                     cv::BORDER_CONSTANT,
                     255);
  return framed;
}

// Draws marker `id`, whose black square has its lower left corner at `at` in
// the plane z = 0, as the camera sees it; four times as large, then reduced.
void DrawMarker(const View& view,
                const Camera& camera,
                int id,
                const Vector3d& at,
                cv::Mat& image) {
  constexpr int kOver = 4;
  const double cell = kSide / 6;
  const Vector3d origin = at - Vector3d(cell, cell, 0);
  const double size = 8 * cell;
  const float last = 8 * kCellPx - 0.5F;
  const cv::Point2f texture[] = {
      {-0.5F, -0.5F}, {last, -0.5F}, {last, last}, {-0.5F, last}};
  const Vector3d corners[] = {origin + Vector3d(0, size, 0),
                              origin + Vector3d(size, size, 0),
                              origin + Vector3d(size, 0, 0),
                              origin};
  cv::Point2f seen[4];
  for (int i = 0; i < 4; ++i) {
    const auto pixel = Project(camera, view.cam_from_world, corners[i]);
    ASSERT_TRUE(pixel);
    seen[i] = {static_cast<float>(kOver * pixel->x() - 0.5),
               static_cast<float>(kOver * pixel->y() - 0.5)};
  }
  cv::Mat large;
  cv::resize(image, large, {}, kOver, kOver, cv::INTER_NEAREST);
  cv::warpPerspective(MarkerImage(id),
                      large,
                      cv::getPerspectiveTransform(texture, seen),
                      large.size(),
                      cv::INTER_LINEAR,
                      cv::BORDER_TRANSPARENT);
  cv::resize(large, image, image.size(), 0, 0, cv::INTER_AREA);
}

// Two markers on a table, seen from all around.
class FindMarkersTest : public testing::Test {
 protected:
  void SetUp() override {
    std::vector<PosedView> views;
    for (int i = 0; i < 6; ++i) {
      const double t = 1.05 * i + 0.3;
      views.push_back(
          LookAt({1.2 * std::cos(t), 1.2 * std::sin(t), 1.4}, {0, 0, 0}));
    }
    scene_ = ToScene(views);
    for (View& view : scene_.views) {
      const Camera& camera = CameraOf(scene_, view);
      cv::Mat image(camera.height, camera.width, CV_8U, cv::Scalar(150));
      DrawMarker(view, camera, 3, {-0.4, -0.2, 0}, image);
      DrawMarker(view, camera, 17, {0.1, 0, 0}, image);
      view.image_path = folder_.path() / (view.name + ".png");
      cv::imwrite(view.image_path.string(), image);
    }
  }

  TemporaryFolder folder_;
  Scene scene_;
};

TEST_F(FindMarkersTest, TheyGiveTheScale) {
  const auto found = FindMarkers(scene_, "4x4_50", 35, {2});
  ASSERT_TRUE(found.ok()) << found.status().message();
  ASSERT_EQ(found->markers.size(), 2u);
  EXPECT_EQ(found->markers[0].id, 3);
  EXPECT_EQ(found->markers[1].id, 17);
  EXPECT_LT(found->corner_sigma_px, 0.1);
  for (const FoundMarker& marker : found->markers) {
    EXPECT_EQ(marker.num_views, 6);
    EXPECT_NEAR(marker.side, kSide, 0.001 * kSide);
    EXPECT_LT(std::abs(std::log(marker.scale.scale / 100)),
              2.5 * marker.scale.sigma);
    EXPECT_LT(marker.scale.sigma, 0.001);
  }
}

TEST_F(FindMarkersTest, AnyNumberOfThreadsGivesTheSame) {
  const auto one = FindMarkers(scene_, "4x4_50", 35, {1});
  const auto four = FindMarkers(scene_, "4x4_50", 35, {4});
  ASSERT_TRUE(one.ok() && four.ok());
  for (std::size_t i = 0; i < one->markers.size(); ++i) {
    EXPECT_EQ(one->markers[i].side, four->markers[i].side);
  }
}

TEST_F(FindMarkersTest, SaysThatThereAreNone) {
  const auto other = FindMarkers(scene_, "apriltag_36h11", 1, {1});
  EXPECT_EQ(other.status().code(), StatusCode::kNotFound);
  EXPECT_THAT(other.status().message(), HasSubstr("apriltag_36h11"));
  scene_.views.resize(2);
  EXPECT_THAT(FindMarkers(scene_, "4x4_50", 1, {1}).status().message(),
              HasSubstr("seen by 3 images or more"));
  scene_.views[0].image_path = folder_.path() / "gone.png";
  EXPECT_THAT(FindMarkers(scene_, "4x4_50", 1, {1}).status().message(),
              HasSubstr("gone.png"));
}

TEST(MarkerDictionaries, AreThoseOfArucoAndAprilTag) {
  EXPECT_THAT(MarkerDictionaries(), testing::Contains("apriltag_36h11"));
  EXPECT_THAT(MarkerDictionaries(), testing::Contains("4x4_50"));
}

}  // namespace
}  // namespace curvix

#else

namespace curvix {
namespace {

TEST(MarkerDictionaries, AreNoneWithoutOpenCvs) {
  EXPECT_TRUE(MarkerDictionaries().empty());
}

}  // namespace
}  // namespace curvix

#endif
