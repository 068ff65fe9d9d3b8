// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The images, kept small, to look up grey levels.
#pragma once

#include <curvix/scene.h>

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace curvix {

// An image, slightly blurred and perhaps of reduced size, in 8 bits.
struct BlurredImage {
  int width = 0;
  int height = 0;
  double scale = 1;  // pixels here per pixel of the file, in (0, 1]
  std::vector<std::uint8_t> pixels;  // row by row
  double noise_variance = 0;         // of the pixels, squared grey levels

  // Whether grey levels within `reach` pixels of the file around `pixel`, one
  // of the file, are known.
  bool Covers(const Eigen::Vector2d& pixel, double reach) const {
    const Eigen::Vector2d at = pixel * scale;
    const double margin = reach * scale + 1;
    return at.x() >= margin && at.y() >= margin && at.x() < width - margin &&
           at.y() < height - margin;
  }

  // Grey levels, 0..255, bilinear, at (x[i], y[i]) in pixels here, of which the
  // first has its centre at (0, 0); from 0 to width - 1 and height - 1. Of at
  // least two pixels either way. As many `values` as `x` and `y`.
  void LookUp(std::span<const float> x,
              std::span<const float> y,
              float* values) const;
};

// One per view, in order; empty where the image cannot be read. If all of them
// would take more than a gigabyte, they are halved until they do not.
std::vector<BlurredImage> LoadBlurredImages(const Scene& scene,
                                            int num_threads);

}  // namespace curvix
