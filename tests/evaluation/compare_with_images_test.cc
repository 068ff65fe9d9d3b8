// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "evaluation/image_agreement.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;

// Three cameras a metre apart in a row, 5 m before a wall whose left half is
// dark; the border is the line x = 0. Focal length 100, 200 x 160 pixels.
class WallTest : public ::testing::Test {
 protected:
  WallTest() {
    scene_.cameras = {{CameraModel::kSimplePinhole, 200, 160, {100, 100, 80}}};
    for (int i = 0; i < 3; ++i) {
      View view;
      view.name = std::to_string(i) + ".png";
      view.image_path = folder_.path() / view.name;
      view.cam_from_world.translation = {1.0 - i, 0, 5};
      const int border = 100 + 20 * (1 - i);
      cv::Mat1b image(160, 200, std::uint8_t{50});
      image.colRange(border, 200).setTo(200);
      cv::GaussianBlur(image, image, {}, 1);
      cv::imwrite(view.image_path.string(), image);
      scene_.views.push_back(view);
    }
  }

  static Curve Line(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    Curve curve;
    for (const Eigen::Vector3d& position : {from, to}) {
      CurveSample sample;
      sample.position = position;
      sample.support = {{0, 0}, {1, 0}};
      curve.samples.push_back(sample);
    }
    return curve;
  }

  ImageAgreement Compare(const Curve& curve,
                         const std::vector<int>& view_idxs) const {
    const auto agreement = CompareWithImages({curve}, scene_, view_idxs, 2);
    EXPECT_TRUE(agreement.ok()) << agreement.status().message();
    return *agreement;
  }

  const TemporaryFolder folder_;
  Scene scene_;
};

TEST_F(WallTest, TheBorderIsWhereTheLineIs) {
  const ImageAgreement agreement =
      Compare(Line({0, -3, 0}, {0, 3, 0}), {0, 1, 2});
  EXPECT_EQ(agreement.precision.share, 1);
  EXPECT_GT(agreement.strong_contours.share, 0.7);
  EXPECT_GT(agreement.long_lines.share, 0.7);
  EXPECT_NEAR(agreement.median_piece_px, 120, 1e-6);
}

TEST_F(WallTest, OfLinesThatLeaveTheImageThePartInsideCounts) {
  const ImageAgreement agreement = Compare(Line({0, 0, 0}, {0, 1000, 0}), {1});
  EXPECT_EQ(agreement.precision.share, 1);
  EXPECT_NEAR(agreement.median_piece_px, 78, 2.5);
  const ImageAgreement from_behind =
      Compare(Line({0, 0, 0}, {0, 0.5, -20}), {1});
  EXPECT_GT(from_behind.median_piece_px, 0);
}

TEST_F(WallTest, ALineElsewhereIsOnNoContour) {
  const ImageAgreement agreement = Compare(Line({1, -3, 0}, {1, 3, 0}), {1});
  EXPECT_EQ(agreement.precision.share, 0);
  EXPECT_EQ(agreement.strong_contours.share, 0);
  EXPECT_EQ(agreement.long_lines.share, 0);
}

TEST_F(WallTest, SamplesAreExpectedIfTheNextViewsSupportThem) {
  const Curve line = Line({0, -3, 0}, {0, 3, 0});
  EXPECT_EQ(Compare(line, {2}).expected_precision->share, 1);
  EXPECT_FALSE(Compare(line, {1}).expected_precision.has_value())
      << "view 2 does not support the line";
}

TEST_F(WallTest, AMissingImageIsAnError) {
  scene_.views[1].image_path = folder_.path() / "none.png";
  const auto agreement = CompareWithImages({}, scene_, {0, 1}, 2);
  ASSERT_FALSE(agreement.ok());
  EXPECT_THAT(agreement.status().message(), HasSubstr("none.png"));
}

}  // namespace
}  // namespace curvix
