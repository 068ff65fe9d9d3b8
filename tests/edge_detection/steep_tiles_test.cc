// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/gradient_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "tests/edge_detection/rendered_images.h"

namespace curvix {
namespace {

// A disc that touches the border, flat elsewhere, and one white pixel.
GrayImage MostlyFlat() {
  GrayImage image = RenderDisc(100, {88, 91}, 12);
  image.width = 50;
  image.height = 200;
  image.pixels[50 * 40 + 10] = 255;
  return image;
}

bool Contains(const std::vector<PixelRun>& runs, int x) {
  return std::any_of(runs.begin(), runs.end(), [&](const PixelRun& run) {
    return run.begin <= x && x < run.end;
  });
}

TEST(SteepTiles, HoldEveryGradientAboveTheThreshold) {
  const GrayImage image = MostlyFlat();
  for (const DetectionScale& scale : {DetectionScale{0.6, 2},
                                      DetectionScale{1.0, 2},
                                      DetectionScale{1.5, 1},
                                      DetectionScale{2.5, 2}}) {
    GradientRows gradients(image, scale);
    const int n = scale.samples_per_px;
    GradientRow row;
    for (const float span : {0.5f, 20.0f, 150.0f}) {
      const SteepTiles tiles(image, gradients.reach_px(), span);
      int num_flat = 0;
      for (int j = 0; j < gradients.grid_height(); ++j) {
        gradients.Compute(j, {0, image.width}, row);
        for (int x = 0; x < image.width; ++x) {
          if (Contains(tiles.Runs(j / n), x)) continue;
          ++num_flat;
          const auto i = static_cast<std::size_t>(n * x);
          const float steepest =
              std::max(row.magnitude[i],
                       row.magnitude[i + static_cast<std::size_t>(n) - 1]);
          EXPECT_LE(steepest, span * gradients.max_gain() + 1e-3);
        }
      }
      EXPECT_GT(num_flat, 1000) << scale.sigma_px << " px, span " << span;
    }
  }
}

TEST(SteepTiles, RunsAreApartAndWithinTheImage) {
  const GrayImage image = MostlyFlat();
  const SteepTiles tiles(image, 6, 1);
  int num_steep = 0;
  for (int y = 0; y < image.height; ++y) {
    int end_before = -1;
    for (const PixelRun& run : tiles.Runs(y)) {
      EXPECT_GT(run.begin, end_before);
      EXPECT_GT(run.end, run.begin);
      EXPECT_LE(run.end, image.width);
      end_before = run.end;
      num_steep += run.end - run.begin;
    }
  }
  EXPECT_TRUE(Contains(tiles.Runs(40), 10));
  EXPECT_LT(num_steep, image.width * image.height / 2);
}

TEST(SteepTiles, AllAreSteepIfNoneMayBeFlat) {
  const GrayImage blank{40, 30, std::vector<float>(1200, 7)};
  EXPECT_TRUE(SteepTiles(blank, 6, 0).Runs(3).empty());
  const std::vector<PixelRun> runs = SteepTiles(blank, 6, -1).Runs(3);
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].begin, 0);
  EXPECT_EQ(runs[0].end, 40);
}

TEST(GradientRows, OfPartsAreThoseOfTheWhole) {
  GrayImage image = RenderDisc(60, {33.2, 28.7}, 14.6);
  AddNoise(5, 1, image);
  for (const int n : {1, 2}) {
    GradientRows gradients(image, {1, n});
    GradientRow whole, part;
    for (const int j : {0, 1, 57, 59 * n}) {
      gradients.Compute(j, {0, 60}, whole);
      for (const PixelRun run :
           {PixelRun{0, 1}, {0, 8}, {3, 20}, {30, 47}, {59, 60}}) {
        gradients.Compute(j, run, part);
        for (int i = n * run.begin; i < n * run.end; ++i) {
          const auto k = static_cast<std::size_t>(i);
          EXPECT_EQ(part.x[k], whole.x[k]);
          EXPECT_EQ(part.y[k], whole.y[k]);
          EXPECT_EQ(part.magnitude[k], whole.magnitude[k]);
        }
      }
    }
  }
}

}  // namespace
}  // namespace curvix
