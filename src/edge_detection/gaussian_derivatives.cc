// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. Gaussian derivative filters.
#include "edge_detection/gaussian_derivatives.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"

namespace curvix {
namespace {

// Weights of the samples at -1, 0, 1, 2 for the value at t in [0, 1].
std::array<double, 4> CubicWeights(double t) {
  return {((-0.5 * t + 1) * t - 0.5) * t,
          (1.5 * t - 2.5) * t * t + 1,
          ((-1.5 * t + 2) * t + 0.5) * t,
          (0.5 * t - 0.5) * t * t};
}

}  // namespace

std::array<double, 4> GaussianDerivatives(double x, double sigma) {
  const double u = x / sigma;
  const double g = std::exp(-u * u / 2) / (std::sqrt(2 * kPi) * sigma);
  return {g,
          -u * g / sigma,
          (u * u - 1) * g / (sigma * sigma),
          (3 - u * u) * u * g / (sigma * sigma * sigma)};
}

int GaussianRadius(double sigma) {
  return static_cast<int>(std::ceil(5 * sigma));
}

int PixelFilterRadius(double sigma) {
  return static_cast<int>(std::ceil(4 * sigma));
}

double GradientNoiseGain(double sigma_px) {
  return 1 / (std::sqrt(8 * kPi) * sigma_px * sigma_px);
}

ImageDerivatives::ImageDerivatives(const GrayImage& image, double sigma_px)
    : image_(image),
      radius_(GaussianRadius(sigma_px)),
      pixel_radius_(PixelFilterRadius(sigma_px)) {
  const int reach = 2 * radius_ + 1;
  for (int half_pixels = -reach; half_pixels <= reach; ++half_pixels) {
    const auto g = GaussianDerivatives(half_pixels / 2.0, sigma_px);
    table_.push_back(Eigen::Array4d(g[0], g[1], g[2], g[3]).cast<float>());
  }
  const auto size = static_cast<std::size_t>(2 * radius_ + 3);
  x_.weights.resize(size);
  y_.weights.resize(size);
}

void ImageDerivatives::SetFilter(double position, Filter& filter) const {
  // On the half-pixel grid, pixel i is at 2 * i.
  const double on_grid = 2 * position - 1;
  const int cell = static_cast<int>(std::floor(on_grid));
  const std::array<double, 4> cubic = CubicWeights(on_grid - cell);
  const int reach = 2 * radius_ + 1;
  filter.first_pixel = (cell + 1) / 2 - radius_ - 1;
  int pixel = filter.first_pixel;
  for (Weights& weights : filter.weights) {
    weights = {Orders::Zero(), Orders::Zero(), Orders::Zero()};
    for (int k = 0; k < 4; ++k) {
      const int half_pixels = cell - 1 + k - 2 * pixel;
      if (std::abs(half_pixels) > reach) continue;
      const Orders share =
          static_cast<float>(cubic[static_cast<std::size_t>(k)]) *
          table_[static_cast<std::size_t>(half_pixels + reach)];
      if (half_pixels % 2 != 0) {
        weights.between += share;
        continue;
      }
      weights.on_pixel += share;
      if (std::abs(half_pixels) <= 2 * pixel_radius_) {
        weights.near_pixel += share;
      }
    }
    ++pixel;
  }
}

ImageDerivatives::Weights ImageDerivatives::AlongRow(int row) const {
  const int inside = std::clamp(row, 0, image_.height - 1);
  Weights sum{Orders::Zero(), Orders::Zero(), Orders::Zero()};
  int column = x_.first_pixel;
  for (const Weights& weights : x_.weights) {
    const float value =
        image_.at(std::clamp(column, 0, image_.width - 1), inside);
    sum.between += value * weights.between;
    sum.on_pixel += value * weights.on_pixel;
    sum.near_pixel += value * weights.near_pixel;
    ++column;
  }
  return sum;
}

Eigen::Matrix4d ImageDerivatives::At(const Eigen::Vector2d& position) {
  SetFilter(position.x(), x_);
  SetFilter(position.y(), y_);
  Eigen::Array44f derivatives = Eigen::Array44f::Zero();  // column: order in x
  int row = y_.first_pixel;
  for (const Weights& across : y_.weights) {
    const Weights along = AlongRow(row++);
    // Grid points that are pixel centres, on a pixel along both axes, have the
    // shorter filters.
    const Orders along_any = along.between + along.on_pixel;
    for (int order = 0; order < 4; ++order) {
      derivatives.col(order) += across.between * along_any[order] +
                                across.on_pixel * along.between[order] +
                                across.near_pixel * along.near_pixel[order];
    }
  }
  return derivatives.matrix().cast<double>();
}

}  // namespace curvix
