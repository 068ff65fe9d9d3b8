// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/export/small_images.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "io/curve_style.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

// A black photograph of 200 x 100 pixels, twice, and a curve across its middle,
// whose right half the first view supports and the second does not.
class OverlayTest : public ::testing::Test {
 protected:
  OverlayTest() {
    scene_.cameras = {{CameraModel::kSimplePinhole, 200, 100, {100, 100, 50}}};
    const std::filesystem::path path = folder_.path() / "photograph.png";
    cv::imwrite(path.string(), cv::Mat3b(100, 200, {0, 0, 0}));
    for (int i = 0; i < 2; ++i) {
      View view;
      view.image_path = path;
      view.cam_from_world.translation = {0, 0, 1};
      scene_.views.push_back(view);
    }
    Curve curve;
    for (int i = -90; i <= 90; ++i) {
      CurveSample sample;
      sample.position = {0.01 * i, 0, 0};
      if (i > 0) sample.support = {{0, 0}};
      curve.samples.push_back(sample);
    }
    curves_.curves.push_back(curve);
  }

  // Columns in which a pixel has the colour of the curve.
  std::vector<int> ColouredColumns(int view_idx) const {
    const CurvesInMemory curves(curves_);
    const auto png = OverlayPng(curves, scene_, view_idx);
    EXPECT_TRUE(png.ok()) << png.status().message();
    const cv::Mat3b image = cv::imdecode(
        std::vector<unsigned char>(png->begin(), png->end()), cv::IMREAD_COLOR);
    const auto [red, green, blue] = CurveColor(0);
    std::vector<int> columns;
    for (int x = 0; x < image.cols; ++x) {
      for (int y = 0; y < image.rows; ++y) {
        if (image(y, x) == cv::Vec3b(blue, green, red)) {
          columns.push_back(x);
          break;
        }
      }
    }
    return columns;
  }

  const TemporaryFolder folder_;
  Scene scene_;
  CurveSet curves_;
};

TEST_F(OverlayTest, CurvesHaveTheirColourWhereTheViewSupportsThem) {
  const std::vector<int> columns = ColouredColumns(0);
  EXPECT_NEAR(static_cast<double>(columns.size()), 90, 3);
  EXPECT_GE(columns.front(), 98);
  EXPECT_TRUE(ColouredColumns(1).empty());
}

TEST_F(OverlayTest, ImagesInMemoryAreShownAsTheirFiles) {
  const std::vector<std::string> black = SmallPinholeJpegs(scene_, {0}, 100, 1);
  const auto values = std::make_shared<std::vector<std::uint16_t>>(60000, 0);
  scene_.views[0].image = {
      200,
      100,
      3,
      std::shared_ptr<const std::uint16_t[]>(values, values->data())};
  EXPECT_EQ(SmallPinholeJpegs(scene_, {0}, 100, 1), black);
  // Red.
  for (std::size_t i = 0; i < values->size(); i += 3) (*values)[i] = 65535;
  const std::string jpeg = SmallPinholeJpegs(scene_, {0}, 100, 1).front();
  const cv::Mat3b image = cv::imdecode(
      std::vector<unsigned char>(jpeg.begin(), jpeg.end()), cv::IMREAD_COLOR);
  EXPECT_LT(cv::norm(image(20, 50), cv::Vec3b(0, 0, 255)), 5);
}

TEST_F(OverlayTest, ShortGapsOfSupportAreDrawnThrough) {
  std::vector<CurveSample>& samples = curves_.curves[0].samples;
  samples[120].support.clear();
  samples[121].support.clear();
  EXPECT_NEAR(static_cast<double>(ColouredColumns(0).size()), 90, 3);
  for (std::size_t i = 122; i < 150; ++i) samples[i].support.clear();
  EXPECT_NEAR(static_cast<double>(ColouredColumns(0).size()), 60, 6);
}

TEST_F(OverlayTest, AMissingImageIsAnError) {
  scene_.views[0].image_path = folder_.path() / "none.png";
  EXPECT_FALSE(OverlayPng(CurvesInMemory(curves_), scene_, 0).ok());
}

}  // namespace
}  // namespace curvix
