// SPDX-License-Identifier: BSD-3-Clause
// Images whose edges are known exactly: blurred steps sampled at pixel centres.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>

#include "base/gray_image.h"

namespace curvix {

// Enough for the samples to hold the step without aliasing: at 0.5 px, aliasing
// would turn even a perfect detector's tangents by a degree.
inline constexpr double kRenderedBlurPx = 0.9;
inline constexpr float kDark = 60;
inline constexpr float kBright = 160;

// signed_distance(p) in pixels: positive on the bright side, 0 on the edge.
template <typename F>
GrayImage RenderStep(int width, int height, const F& signed_distance) {
  GrayImage image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double s = signed_distance(Eigen::Vector2d(x + 0.5, y + 0.5));
      const double share =
          0.5 * (1 + std::erf(s / (std::sqrt(2.0) * kRenderedBlurPx)));
      image.pixels.push_back(
          static_cast<float>(kDark + (kBright - kDark) * share));
    }
  }
  return image;
}

// A line through `point` with direction `angle`, brighter on the side of
// (-sin, cos).
inline GrayImage RenderLine(int size,
                            const Eigen::Vector2d& point,
                            double angle) {
  const Eigen::Vector2d normal(-std::sin(angle), std::cos(angle));
  return RenderStep(size, size, [&](const Eigen::Vector2d& p) {
    return normal.dot(p - point);
  });
}

// A bright disc.
inline GrayImage RenderDisc(int size,
                            const Eigen::Vector2d& center,
                            double radius) {
  return RenderStep(size, size, [&](const Eigen::Vector2d& p) {
    return radius - (p - center).norm();
  });
}

inline void AddNoise(double sigma, std::uint32_t seed, GrayImage& image) {
  std::mt19937 generator(seed);
  std::normal_distribution<float> noise(0, static_cast<float>(sigma));
  for (float& pixel : image.pixels) pixel += noise(generator);
}

}  // namespace curvix
