// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. The gradient of an image at half-pixel sampling.
#pragma once

#include <array>
#include <vector>

#include "edge_detection/gray_image.h"

namespace curvix {

// One row of the half-pixel grid. Grid point (i, j) is the pixel (i / 2, j / 2)
// counted between pixel centres from (0, 0), that is (i / 2 + 0.5, j / 2 + 0.5)
// in the library's coordinates. 2 * width - 1 points each.
struct GradientRow {
  std::vector<float> x;  // grey levels per pixel
  std::vector<float> y;
  std::vector<float> magnitude;
};

// Computes gradients with Gaussian derivative filters, row by row, so that no
// plane of the fine grid is ever stored. The image continues beyond its border
// with its border values. Costs about 60 multiply-adds per grid point for
// sigma = 1.
class GradientRows {
 public:
  // `image` must outlive this object; its size is at least 1 x 1; sigma > 0.
  GradientRows(const GrayImage& image, double sigma_px);

  int grid_width() const { return 2 * image_.width - 1; }
  int grid_height() const { return 2 * image_.height - 1; }

  // 0 <= grid_row < grid_height().
  void Compute(int grid_row, GradientRow& row);

 private:
  // Weights of the samples at distance k + phase / 2 on either side. The centre
  // counts as both of its sides, so its smoothing weight is halved.
  struct Taps {
    std::vector<float> smooth;
    std::vector<float> derive;
  };

  void FilterColumns(int grid_row);
  void FilterRow(const std::vector<float>& padded,
                 const std::vector<float> Taps::*weights,
                 float sign,
                 std::vector<float>& out);

  const GrayImage& image_;
  int radius_;                  // taps reach up to radius_ + 1 pixels
  std::array<Taps, 2> taps_;    // by phase: on a pixel, between two pixels
  std::vector<float> smooth_;   // padded by radius_ + 1 on either side
  std::vector<float> derived_;  // likewise
  std::array<std::vector<float>, 2> phases_;  // of one filtered row
};

}  // namespace curvix
