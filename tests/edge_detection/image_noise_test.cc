// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/detect_view_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "edge_detection/gaussian_derivatives.h"
#include "edge_detection/gradient_rows.h"
#include "tests/edge_detection/rendered_images.h"

namespace curvix {
namespace {

TEST(EstimateNoise, IsZeroWithoutNoise) {
  EXPECT_EQ(EstimateNoise(RenderDisc(128, {64, 64}, 40)), 0);
  GrayImage ramp{100, 100, {}};
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < 100; ++column) {
      ramp.pixels.push_back(static_cast<float>(20 + column + row));
    }
  }
  EXPECT_EQ(EstimateNoise(ramp), 0);
}

TEST(EstimateNoise, FindsTheNoiseBesideEdges) {
  for (const double sigma : {1.0, 2.0, 5.0, 10.0}) {
    GrayImage image = RenderDisc(200, {100, 100}, 60);
    AddNoise(sigma, 7, image);
    EXPECT_NEAR(EstimateNoise(image), sigma, 0.1 * sigma);
  }
}

TEST(EstimateNoise, NeedsNotAllOfALargeImage) {
  for (const int size : {1500, 2100}) {
    const auto num_pixels = static_cast<std::size_t>(size * size);
    GrayImage image{size, size, std::vector<float>(num_pixels, 100)};
    AddNoise(3, 7, image);
    EXPECT_NEAR(EstimateNoise(image), 3, 0.1);
  }
}

TEST(EstimateNoise, IsNotFooledByClippedBackground) {
  GrayImage image = RenderDisc(200, {100, 100}, 60);
  for (float& pixel : image.pixels) {
    pixel = pixel < 100 ? 0.0f : pixel;
  }
  AddNoise(3, 7, image);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      const double r = std::hypot(x - 100, y - 100);
      if (r > 65) image.pixels[static_cast<std::size_t>(200 * y + x)] = 0;
    }
  }
  EXPECT_NEAR(EstimateNoise(image), 3, 0.4);
}

TEST(EstimateNoise, IsZeroWhereItCannotBeTold) {
  EXPECT_EQ(EstimateNoise(GrayImage{}), 0);
  EXPECT_EQ(EstimateNoise({4, 4, std::vector<float>(16, 90)}), 0);
  EXPECT_EQ(EstimateNoise({50, 50, std::vector<float>(2500, 255)}), 0);
}

TEST(GradientNoiseGain, PredictsTheGradientOfNoise) {
  for (const DetectionScale& scale : {DetectionScale{0.8, 2},
                                      DetectionScale{1.0, 2},
                                      DetectionScale{2.0, 1}}) {
    GrayImage image{300, 300, std::vector<float>(90000, 100)};
    AddNoise(4, 3, image);
    GradientRows rows(image, scale);
    GradientRow row;
    double sum = 0;
    int count = 0;
    for (int j = 20; j < rows.grid_height() - 20; ++j) {
      rows.Compute(j, {0, image.width}, row);
      for (std::size_t i = 20; i + 20 < row.x.size(); ++i, ++count) {
        sum += row.x[i] * row.x[i];
      }
    }
    const double expected = 4 * GradientNoiseGain(scale.sigma_px);
    EXPECT_NEAR(std::sqrt(sum / count), expected, 0.03 * expected);
  }
}

}  // namespace
}  // namespace curvix
