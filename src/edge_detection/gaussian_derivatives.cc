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

double GradientNoiseGain(double sigma_px) {
  return 1 / (std::sqrt(8 * kPi) * sigma_px * sigma_px);
}

ImageDerivatives::ImageDerivatives(const GrayImage& image, double sigma_px)
    : image_(image), radius_(GaussianRadius(sigma_px)) {
  const int reach = 2 * radius_ + 1;
  table_.resize(2 * reach + 1, 4);
  for (int row = 0; row < table_.rows(); ++row) {
    const auto g = GaussianDerivatives((row - reach) / 2.0, sigma_px);
    table_.row(row) << g[0], g[1], g[2], g[3];
  }
}

ImageDerivatives::Filter ImageDerivatives::FilterAt(double position) const {
  // On the half-pixel grid, pixel i is at 2 * i.
  const double on_grid = 2 * position - 1;
  const int cell = static_cast<int>(std::floor(on_grid));
  const std::array<double, 4> cubic = CubicWeights(on_grid - cell);
  const int reach = 2 * radius_ + 1;
  const int size = 2 * radius_ + 3;
  const int first = (cell + 1) / 2 - radius_ - 1;
  Filter filter{first, decltype(Filter::weights)::Zero(size, 4)};
  for (int i = 0; i < size; ++i) {
    for (int k = 0; k < 4; ++k) {
      const int half_pixels = cell - 1 + k - 2 * (first + i);
      if (std::abs(half_pixels) > reach) continue;
      filter.weights.row(i) +=
          cubic[static_cast<std::size_t>(k)] * table_.row(half_pixels + reach);
    }
  }
  return filter;
}

Eigen::Matrix4d ImageDerivatives::At(const Eigen::Vector2d& position) const {
  const Filter x = FilterAt(position.x());
  const Filter y = FilterAt(position.y());
  Eigen::Matrix4d derivatives = Eigen::Matrix4d::Zero();
  for (int j = 0; j < y.weights.rows(); ++j) {
    const int row = std::clamp(y.first_pixel + j, 0, image_.height - 1);
    Eigen::RowVector4d along_row = Eigen::RowVector4d::Zero();
    for (int i = 0; i < x.weights.rows(); ++i) {
      const int column = std::clamp(x.first_pixel + i, 0, image_.width - 1);
      along_row += image_.at(column, row) * x.weights.row(i);
    }
    derivatives += y.weights.row(j).transpose() * along_row;
  }
  return derivatives;
}

}  // namespace curvix
