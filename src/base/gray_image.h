// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

namespace curvix {

// Row-major grey values in 0..255; fractions are kept.
struct GrayImage {
  int width = 0;
  int height = 0;
  std::vector<float> pixels;

  float at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) *
                      static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

// The grey value between the centres of pixels, which are at 0.5; at the border
// the nearest pixels. The image has at least two pixels either way.
inline double Bilinear(const GrayImage& image, const Eigen::Vector2d& pixel) {
  const double x = std::clamp(pixel.x() - 0.5, 0.0, image.width - 1.0);
  const double y = std::clamp(pixel.y() - 0.5, 0.0, image.height - 1.0);
  const int x0 = std::min(static_cast<int>(x), image.width - 2);
  const int y0 = std::min(static_cast<int>(y), image.height - 2);
  const auto at = [&](int column, int row) {
    return static_cast<double>(image.at(column, row));
  };
  const double fx = x - x0;
  const double fy = y - y0;
  return (1 - fy) * ((1 - fx) * at(x0, y0) + fx * at(x0 + 1, y0)) +
         fy * ((1 - fx) * at(x0, y0 + 1) + fx * at(x0 + 1, y0 + 1));
}

}  // namespace curvix
