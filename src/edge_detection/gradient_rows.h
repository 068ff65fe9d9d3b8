// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. The gradient of an image on a grid, and the flat
// parts of the image, in which nothing needs to be computed.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/gray_image.h"

namespace curvix {

// Pixels [begin, end) of a row.
struct PixelRun {
  int begin = 0;
  int end = 0;
};

// Which square tiles of an image are not flat. A tile is flat if its pixels and
// those of the eight tiles around it span at most `max_span` grey levels:
// whatever is computed from pixels no further than `reach_px` away sees no more
// contrast than that.
class SteepTiles {
 public:
  // reach_px >= 0. A negative `max_span` makes every tile steep.
  SteepTiles(const GrayImage& image, int reach_px, float max_span);

  // The pixels of row `y` that lie in steep tiles, in rising order; apart from
  // each other. 0 <= y < height.
  const std::vector<PixelRun>& Runs(int y) const {
    return runs_[static_cast<std::size_t>(y / side_)];
  }

 private:
  int side_;                                 // pixels
  std::vector<std::vector<PixelRun>> runs_;  // by row of tiles
};

// At which edges of an image are detected.
struct DetectionScale {
  double sigma_px = 1;     // of the Gaussian derivatives, > 0
  int samples_per_px = 2;  // along each axis, 1 or 2

  // Of edges along a contour.
  double spacing_px() const { return 1.0 / samples_per_px; }
};

// One row of a grid with n points per pixel along each axis. Grid point (i, j)
// is the pixel (i / n, j / n) counted between pixel centres from (0, 0), that
// is (i / n + 0.5, j / n + 0.5) in the library's coordinates. n * width points
// each, of which the last n - 1 lie beyond the last pixel.
struct GradientRow {
  std::vector<float> x;  // grey levels per pixel
  std::vector<float> y;
  std::vector<float> magnitude;
};

// Computes gradients with Gaussian derivative filters, row by row and only
// where asked, so that no plane of the fine grid is ever stored. The image
// continues beyond its border with its border values. Costs about 60
// multiply-adds per grid point for sigma = 1.
class GradientRows {
 public:
  // `image` must outlive this object; its size is at least 1 x 1.
  GradientRows(const GrayImage& image, const DetectionScale& scale);

  int samples_per_px() const { return samples_per_px_; }
  int grid_width() const { return samples_per_px_ * (image_.width - 1) + 1; }
  int grid_height() const { return samples_per_px_ * (image_.height - 1) + 1; }

  // How many pixels away the furthest pixel is that a gradient depends on.
  int reach_px() const { return radius_ + 1; }
  // The gradient is at most so many times the span of the grey levels that it
  // depends on. Per pixel.
  double max_gain() const { return max_gain_; }

  // Sets the grid points n * run.begin to n * run.end - 1 of `row` and leaves
  // the others. 0 <= grid_row < grid_height(); the run is not empty and lies
  // within the image.
  void Compute(int grid_row, const PixelRun& run, GradientRow& row);

 private:
  // Weights of the samples at distance k + phase / 2 on either side. The centre
  // counts as both of its sides, so its smoothing weight is halved.
  struct Taps {
    std::vector<float> smooth;
    std::vector<float> derive;
  };

  // Two rows of samples, as far from the filter's centre on either side.
  struct Pair {
    const float* a;
    const float* b;
  };

  static void SumPairs(const std::vector<Pair>& pairs,
                       const std::vector<float>& weights,
                       float sign,
                       std::size_t n,
                       float* out);
  void FilterColumns(int grid_row, const PixelRun& run);
  void FilterRow(const std::vector<float>& padded,
                 const std::vector<float> Taps::*weights,
                 float sign,
                 const PixelRun& run,
                 std::vector<float>& out);

  const GrayImage& image_;
  int samples_per_px_;  // 1 or 2
  int radius_;          // taps reach up to radius_ + 1 pixels
  double max_gain_;
  std::array<Taps, 2> taps_;    // by phase: on a pixel, between two pixels
  std::vector<float> smooth_;   // padded by radius_ + 1 on either side
  std::vector<float> derived_;  // likewise
  std::array<std::vector<float>, 2> phases_;  // of one filtered row
  std::vector<Pair> pairs_;                   // of one filter
};

}  // namespace curvix
