// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/detect_view_edges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/median.h"
#include "edge_detection/gaussian_derivatives.h"
#include "geometry/detected_edge.h"
#include "tests/edge_detection/rendered_images.h"
#include "tests/support/picture.h"
#include "tests/support/temporary_folder.h"

namespace curvix {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// A view of an image file that lives as long as the object.
class ImageFile {
 public:
  explicit ImageFile(const GrayImage& image) {
    cv::Mat pixels(image.height, image.width, CV_8UC1);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        pixels.at<unsigned char>(y, x) =
            cv::saturate_cast<unsigned char>(image.at(x, y));
      }
    }
    EXPECT_TRUE(cv::imwrite(path_.string(), pixels));
  }

  View view() const {
    View view;
    view.name = path_.filename().string();
    view.image_path = path_;
    return view;
  }

 private:
  const TemporaryFolder folder_;
  const fs::path path_ = folder_.path() / "view.png";
};

Camera PinholeOfSize(int width, int height) {
  return {CameraModel::kSimplePinhole,
          width,
          height,
          {100, width / 2.0, height / 2.0}};
}

TEST(DetectViewEdges, FindsAndLinksTheEdgesOfAFile) {
  const Eigen::Vector2d center(50.4, 49.1);
  const ImageFile file(RenderDisc(100, center, 30));
  const Result<EdgeMap> map =
      DetectViewEdges(file.view(), PinholeOfSize(100, 100), {});
  ASSERT_TRUE(map.ok()) << map.status().message();
  ASSERT_GT(map->edges.size(), 300u);
  ASSERT_EQ(map->neighbors.size(), map->edges.size());
  EXPECT_LT(map->noise, 0.5);
  for (std::size_t i = 0; i < map->edges.size(); ++i) {
    const double r = (map->edges[i].position - center).norm();
    EXPECT_NEAR(r, 30, 0.05) << "grey levels are rounded in the file";
    EXPECT_TRUE(map->neighbors[i].next && map->neighbors[i].previous);
  }
}

TEST(DetectViewEdges, KeepsNoiseOut) {
  GrayImage noise{200, 200, std::vector<float>(40000, 128)};
  AddNoise(8, 11, noise);
  const ImageFile file(noise);
  const Result<EdgeMap> map =
      DetectViewEdges(file.view(), PinholeOfSize(200, 200), {});
  ASSERT_TRUE(map.ok());
  EXPECT_NEAR(map->noise, 8, 0.8);
  EXPECT_LT(map->edges.size(), 20u);
}

// A view of the disc whose mask is black left of `x`.
Result<EdgeMap> DetectMasked(int x, const cv::Size& mask_size) {
  const ImageFile file(RenderDisc(100, {50, 50}, 30));
  const TemporaryFolder folder;
  const fs::path mask_path = folder.path() / "mask.png";
  cv::Mat mask(mask_size, CV_8UC1, cv::Scalar(255));
  mask.colRange(0, x).setTo(0);
  EXPECT_TRUE(cv::imwrite(mask_path.string(), mask));
  View view = file.view();
  view.mask_path = mask_path;
  return DetectViewEdges(view, PinholeOfSize(100, 100), {});
}

TEST(DetectViewEdges, LeavesOutWhatTheMaskBlackens) {
  const Result<EdgeMap> all = DetectMasked(0, {100, 100});
  const Result<EdgeMap> half = DetectMasked(50, {100, 100});
  ASSERT_TRUE(all.ok() && half.ok());
  EXPECT_EQ(all->num_dropped_masked, 0);
  EXPECT_GT(half->edges.size(), 100u);
  EXPECT_EQ(
      half->edges.size() + static_cast<std::size_t>(half->num_dropped_masked),
      all->edges.size());
  for (const Edge2d& edge : half->edges) EXPECT_GE(edge.position.x(), 50);
  EXPECT_TRUE(half->unseen.Contain({30, 50}));
  EXPECT_FALSE(half->unseen.Contain({70, 50}));
}

TEST(DetectViewEdges, TakesAMaskInAnotherSize) {
  const Result<EdgeMap> expected = DetectMasked(50, {100, 100});
  for (const int percent : {50, 200, 300}) {
    const Result<EdgeMap> map = DetectMasked(percent / 2, {percent, percent});
    ASSERT_TRUE(map.ok()) << map.status().message();
    EXPECT_EQ(map->edges.size(), expected->edges.size()) << percent;
  }
}

TEST(DetectViewEdges, RefusesAMaskOfAnotherShape) {
  const Result<EdgeMap> map = DetectMasked(0, {50, 52});
  EXPECT_EQ(map.status().code(), StatusCode::kInvalidArgument);
  EXPECT_THAT(map.status().message(),
              testing::ContainsRegex("^Mask .*mask.png is 50 x 52 pixels"));
}

TEST(DetectViewEdges, NamesBothSizesWhereTheyDiffer) {
  const ImageFile file(RenderDisc(100, {50, 50}, 30));
  const Result<EdgeMap> map =
      DetectViewEdges(file.view(), PinholeOfSize(200, 150), {});
  EXPECT_EQ(map.status().code(), StatusCode::kInvalidArgument);
  EXPECT_THAT(map.status().message(), HasSubstr("100 x 100"));
  EXPECT_THAT(map.status().message(), HasSubstr("200 x 150"));
}

TEST(DetectViewEdges, PassesOnThatTheImageIsMissing) {
  View view;
  view.image_path = fs::path(::testing::TempDir()) / "no_such_view.png";
  EXPECT_EQ(DetectViewEdges(view, PinholeOfSize(9, 9), {}).status().code(),
            StatusCode::kNotFound);
}

TEST(DetectViewEdges, CountsWhatItDrops) {
  GrayImage image = RenderDisc(600, {300, 300}, 150);
  AddNoise(8, 11, image);
  const ImageFile file(image);
  EdgeDetectionOptions options;
  options.noise_factor = 1;
  options.max_edges_per_megapixel = 1e9;
  const auto detect = [&] {
    return DetectViewEdges(file.view(), PinholeOfSize(600, 600), options);
  };
  const Result<EdgeMap> bounded_by_noise = detect();
  options.max_edges_per_megapixel = 1;
  const Result<EdgeMap> bounded = detect();
  options.min_contour_edges = 1;
  options.max_edges_per_megapixel = 1e9;
  const Result<EdgeMap> all = detect();
  ASSERT_TRUE(bounded_by_noise.ok() && bounded.ok() && all.ok());
  EXPECT_EQ(all->num_dropped_isolated, 0);
  EXPECT_EQ(all->num_dropped_over_limit, 0);
  EXPECT_EQ(
      bounded_by_noise->edges.size() +
          static_cast<std::size_t>(bounded_by_noise->num_dropped_isolated),
      all->edges.size());
  EXPECT_GT(bounded_by_noise->num_dropped_isolated, 1000);
  EXPECT_EQ(bounded_by_noise->num_dropped_over_limit, 0);
  EXPECT_LE(bounded->edges.size(), 20000u);
  EXPECT_GT(bounded->edges.size(), 10000u);
  EXPECT_GT(bounded->spacing_px, 0.8);
  const auto on_disc = std::count_if(
      bounded->edges.begin(), bounded->edges.end(), [](const Edge2d& edge) {
        return std::abs((edge.position - Eigen::Vector2d(300, 300)).norm() -
                        150) < 1;
      });
  EXPECT_GT(on_disc, 600) << "the disc outlives the noise";
}

// The edges of an image of 600 x 600 pixels under noise, most of which counts
// as edges: with a limit that makes the image crowded, and with none.
std::pair<Result<EdgeMap>, Result<EdgeMap>> DetectCrowdedAndNot(
    GrayImage image, EdgeDetectionOptions options) {
  AddNoise(8, 11, image);
  const ImageFile file(image);
  options.noise_factor = 1;
  options.max_edges_per_megapixel = 1;
  Result<EdgeMap> crowded =
      DetectViewEdges(file.view(), PinholeOfSize(600, 600), options);
  options.max_edges_per_megapixel = 1e9;
  Result<EdgeMap> not_crowded =
      DetectViewEdges(file.view(), PinholeOfSize(600, 600), options);
  return {std::move(crowded), std::move(not_crowded)};
}

TEST(DetectViewEdges, MeasuresCrowdingWhereImagesAreCrowded) {
  const Eigen::Vector2d center(300, 300);
  const GrayImage image = RenderDisc(600, center, 150);
  const auto [crowded, not_crowded] = DetectCrowdedAndNot(image, {});
  ASSERT_TRUE(crowded.ok() && not_crowded.ok());
  std::vector<double> of_disc, of_noise;
  for (const Edge2d& edge : crowded->edges) {
    const double r = (edge.position - center).norm();
    (std::abs(r - 150) < 1 ? of_disc : of_noise)
        .push_back(static_cast<double>(edge.crowding));
  }
  EXPECT_LT(Median(of_disc), 0.15);
  EXPECT_GT(Median(of_noise), 0.25);
  for (const Edge2d& edge : not_crowded->edges) {
    ASSERT_EQ(edge.crowding, Eigen::half(0));
  }
}

// The sides of a bright bar repel each other, at the finer scale less.
TEST(DetectViewEdges, MeasuresCrowdedImagesAtTheFinerScale) {
  constexpr double kLeft = 300.3;
  constexpr double kWidth = 3;
  const GrayImage image = Picture(600, 600, [](const Eigen::Vector2d& place) {
    return place.x() > kLeft && place.x() < kLeft + kWidth;
  });
  EdgeDetectionOptions options;
  options.separate_edges = false;
  const auto [crowded, not_crowded] = DetectCrowdedAndNot(image, options);
  ASSERT_TRUE(crowded.ok() && not_crowded.ok());
  std::vector<double> coarse, fine;
  for (const Edge2d& edge : crowded->edges) {
    const double x = edge.position.x();
    if (std::abs(x - kLeft) > 1 || std::abs(std::cos(edge.angle)) > 0.2) {
      continue;
    }
    coarse.push_back(x);
    fine.push_back(x +
                   static_cast<double>(edge.fine_px) * ToBrightSide(edge).x());
  }
  ASSERT_GT(coarse.size(), 200u);
  EXPECT_LT(Median(coarse), kLeft - 0.1);
  EXPECT_NEAR(Median(fine), kLeft, (kLeft - Median(coarse)) / 2);
  EXPECT_DOUBLE_EQ(crowded->fine_variance_gain_px2, 1.5 * 1.5 - 1);
  EXPECT_EQ(not_crowded->fine_variance_gain_px2, 0);
  for (const Edge2d& edge : not_crowded->edges) {
    ASSERT_EQ(edge.fine_px, Eigen::half(0));
  }
}

// Across a blurred step the sharpness is 1 / w^2, w^2 the sum of the squares of
// the blur and of the detector's own scale.
TEST(DetectViewEdges, SeesCrowdedImagesAtTheCoarserScale) {
  GrayImage image = RenderDisc(600, {300, 300}, 150);
  AddNoise(8, 11, image);
  const ImageFile file(image);
  EdgeDetectionOptions options;
  options.noise_factor = 1;
  const auto sharpness_on_disc = [&] {
    const auto map =
        DetectViewEdges(file.view(), PinholeOfSize(600, 600), options);
    std::vector<double> sharpness;
    for (const Edge2d& edge : map->edges) {
      const double r = (edge.position - Eigen::Vector2d(300, 300)).norm();
      if (std::abs(r - 150) < 0.5)
        sharpness.push_back(static_cast<double>(edge.sharpness));
    }
    return Median(sharpness);
  };
  const auto expected = [](double sigma_px) {
    return 1 / (sigma_px * sigma_px + kRenderedBlurPx * kRenderedBlurPx);
  };
  EXPECT_NEAR(sharpness_on_disc(), expected(1.5), 0.1 * expected(1.5));
  options.crowded_scale = 1.25;
  EXPECT_NEAR(sharpness_on_disc(), expected(1.25), 0.1 * expected(1.25));
  options.crowded_scale = 1;
  EXPECT_NEAR(sharpness_on_disc(), expected(1), 0.1 * expected(1));
  options.crowded_scale = 1.5;
  options.max_edges_per_megapixel = 1e9;
  EXPECT_NEAR(sharpness_on_disc(), expected(1), 0.1 * expected(1))
      << "no image is crowded";
}

TEST(MaxEdges, GrowsWithTheImage) {
  EdgeDetectionOptions options;
  options.max_edges_per_megapixel = 30000;
  EXPECT_EQ(MaxEdges(options, 1000, 1000), 30000);
  EXPECT_EQ(MaxEdges(options, 8000, 4000), 16 * 30000);
  EXPECT_EQ(MaxEdges(options, 100, 100), 20000);
  options.max_edges_per_megapixel = 1e300;
  EXPECT_GT(MaxEdges(options, 2000, 1000), 2000 * 1000);
}

TEST(GradientThreshold, IsTheLargerOfTheTwo) {
  EdgeDetectionOptions options;
  options.min_gradient = 2;
  options.noise_factor = 5;
  EXPECT_EQ(GradientThreshold(options, 1, 0), 2);
  EXPECT_DOUBLE_EQ(GradientThreshold(options, 1.5, 10),
                   50 * GradientNoiseGain(1.5));
}

}  // namespace
}  // namespace curvix
