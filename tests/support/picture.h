// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "base/gray_image.h"

namespace curvix {

// What an ideal camera sees: each pixel tells the mean light on its area, which
// is 160 where is_bright(place) and 60 elsewhere.
template <typename IsBright>
GrayImage Picture(int width, int height, const IsBright& is_bright) {
  constexpr int kParts = 16;  // of a pixel, each way
  GrayImage image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      int num_bright = 0;
      for (int part = 0; part < kParts * kParts; ++part) {
        const int column = part % kParts;
        const int row = part / kParts;
        const Eigen::Vector2d place(x + (column + 0.5) / kParts,
                                    y + (row + 0.5) / kParts);
        if (is_bright(place)) ++num_bright;
      }
      image.pixels.push_back(60 + 100 * static_cast<float>(num_bright) /
                                      (kParts * kParts));
    }
  }
  return image;
}

}  // namespace curvix
