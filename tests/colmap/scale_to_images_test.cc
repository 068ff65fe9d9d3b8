// SPDX-License-Identifier: BSD-3-Clause
#include "colmap/scale_to_images.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string BigEndian(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += static_cast<char>(number >> shift & 0xFF);
  }
  return bytes;
}

// All that a size needs.
std::string HeaderOfPng(int width, int height) {
  return "\x89PNG\r\n\x1a\n" + BigEndian(13) + "IHDR" +
         BigEndian(static_cast<std::uint32_t>(width)) +
         BigEndian(static_cast<std::uint32_t>(height));
}

class ScaleToImagesTest : public ::testing::Test {
 protected:
  // A camera with one image a.png and a 2D point at (400, 300).
  void SetUp() override {
    AddCamera(1,
              {CameraModel::kOpenCV,
               800,
               600,
               {700, 710, 410, 290, -0.1, 0.02, 0.001, 0.002}},
              "a.png");
    ColmapPoint3D point;
    point.error = 0.5;
    model_.points = {point};
  }

  void AddCamera(std::uint32_t id,
                 const Camera& camera,
                 const std::string& image_name) {
    model_.cameras.push_back({id, camera});
    ColmapImage image;
    image.image_id = id;
    image.camera_id = id;
    image.name = image_name;
    image.points2D = {{400, 300, 1}};
    model_.images.push_back(image);
  }

  std::string ScaleTo(int width, int height) {
    folder_.Write("a.png", HeaderOfPng(width, height));
    return ScaleToImages(folder_.path(), &model_);
  }

  // Images of this size leave the model as it is.
  void ExpectLeft(int width, int height) {
    EXPECT_EQ(ScaleTo(width, height), "");
    ExpectUntouched();
  }

  void ExpectUntouched() const {
    const Camera& camera = model_.cameras[0].camera;
    EXPECT_EQ(camera.width, 800);
    EXPECT_EQ(camera.height, 600);
    EXPECT_EQ(camera.params[0], 700);
    EXPECT_EQ(model_.images[0].points2D[0].x, 400);
    EXPECT_EQ(model_.points[0].error, 0.5);
  }

  TemporaryFolder folder_;
  ColmapModel model_;
};

TEST_F(ScaleToImagesTest, ScalesCamerasAndPointsToHalfTheSize) {
  EXPECT_EQ(ScaleTo(400, 300),
            "The images of 1 of 1 camera have another size than the model "
            "says (400 x 300 pixels instead of 800 x 600); this camera is "
            "scaled to them.");
  const Camera& camera = model_.cameras[0].camera;
  EXPECT_EQ(camera.width, 400);
  EXPECT_EQ(camera.height, 300);
  EXPECT_THAT(camera.params,
              ElementsAre(350, 355, 205, 145, -0.1, 0.02, 0.001, 0.002));
  EXPECT_EQ(model_.images[0].points2D[0].x, 200);
  EXPECT_EQ(model_.images[0].points2D[0].y, 150);
  EXPECT_EQ(model_.points[0].error, -1);
}

TEST_F(ScaleToImagesTest, ScalesToLargerImages) {
  EXPECT_THAT(ScaleTo(1600, 1200), HasSubstr("scaled"));
  EXPECT_EQ(model_.cameras[0].camera.params[0], 1400);
}

// 4946 x 3286 pixels, a quarter of which is rounded.
TEST_F(ScaleToImagesTest, TakesRoundedSizes) {
  model_.cameras[0].camera = {
      CameraModel::kSimpleRadial, 4946, 3286, {4000, 2473, 1643, 0.01}};
  EXPECT_THAT(ScaleTo(1237, 822), HasSubstr("scaled"));
  const std::vector<double>& params = model_.cameras[0].camera.params;
  EXPECT_NEAR(params[0], 1000, 1);
  EXPECT_DOUBLE_EQ(params[1], 2473 * (1237 / 4946.0));
  EXPECT_DOUBLE_EQ(params[2], 1643 * (822 / 3286.0));
  EXPECT_EQ(params[3], 0.01);
}

TEST_F(ScaleToImagesTest, ScalesFromRoundedSizes) {
  model_.cameras[0].camera = {
      CameraModel::kSimplePinhole, 618, 411, {500, 309, 205.5}};
  EXPECT_THAT(ScaleTo(4946, 3286), HasSubstr("scaled"));
  EXPECT_NEAR(model_.cameras[0].camera.params[0], 4000, 4);
}

// As behind a large thumbnail.
TEST_F(ScaleToImagesTest, FindsSizesFarBehind) {
  const std::string thumbnail =
      "\xFF\xE1\xFF\xFF" + std::string(0xFFFF - 2, '\0');
  folder_.Write("a.png",
                "\xFF\xD8" + thumbnail + thumbnail +
                    std::string("\xFF\xC0\x00\x11\x08\x01\x2C\x01\x90", 9));
  EXPECT_THAT(ScaleToImages(folder_.path(), &model_), HasSubstr("400 x 300"));
}

TEST_F(ScaleToImagesTest, LeavesCamerasOfTheSameSize) { ExpectLeft(800, 600); }

TEST_F(ScaleToImagesTest, LeavesCamerasOfImagesInOtherProportions) {
  ExpectLeft(400, 320);
  ExpectLeft(600, 800);
}

TEST_F(ScaleToImagesTest, LeavesCamerasOfAbsurdSizes) {
  ExpectLeft(20, 15);
  ExpectLeft(40000, 30000);
}

// A row that is cut off moves nothing.
TEST_F(ScaleToImagesTest, LeavesCamerasOfImagesThatWereCut) {
  ExpectLeft(800, 599);
  ExpectLeft(799, 599);
}

TEST_F(ScaleToImagesTest, LeavesCamerasOfImagesThatTellNoSize) {
  EXPECT_EQ(ScaleToImages(folder_.path(), &model_), "");
  folder_.Write("a.png", "");
  EXPECT_EQ(ScaleToImages(folder_.path(), &model_), "");
  ExpectUntouched();
}

TEST_F(ScaleToImagesTest, LeavesCamerasOfImagesOfSeveralSizes) {
  ColmapImage other = model_.images.front();
  other.image_id = 2;
  other.name = "b.png";
  model_.images.push_back(other);
  folder_.Write("b.png", HeaderOfPng(800, 600));
  ExpectLeft(1600, 1200);
}

TEST_F(ScaleToImagesTest, ScalesOnlyTheCamerasThatNeedIt) {
  AddCamera(
      2, {CameraModel::kSimplePinhole, 800, 600, {700, 400, 300}}, "b.png");
  folder_.Write("b.png", HeaderOfPng(200, 150));
  EXPECT_THAT(ScaleTo(800, 600), HasSubstr("1 of 2 cameras"));
  EXPECT_EQ(model_.cameras[0].camera.params[0], 700);
  EXPECT_EQ(model_.images[0].points2D[0].x, 400);
  EXPECT_THAT(model_.cameras[1].camera.params, ElementsAre(175, 100, 75));
  EXPECT_EQ(model_.images[1].points2D[0].x, 100);
}

}  // namespace
}  // namespace curvix
