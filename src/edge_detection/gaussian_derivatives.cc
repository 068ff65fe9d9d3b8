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
    table_.emplace_back(g[0], g[1], g[2], g[3]);
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
  Filter filter{first, decltype(Filter::weights)::Zero(size, 12)};
  for (int i = 0; i < size; ++i) {
    auto row = filter.weights.row(i);
    for (int k = 0; k < 4; ++k) {
      const int half_pixels = cell - 1 + k - 2 * (first + i);
      if (std::abs(half_pixels) > reach) continue;
      const Orders weights =
          cubic[static_cast<std::size_t>(k)] *
          table_[static_cast<std::size_t>(half_pixels + reach)];
      const bool on_pixel = half_pixels % 2 == 0;
      row.segment<4>(on_pixel ? 4 : 0) += weights;
      if (on_pixel && std::abs(half_pixels) <= 2 * pixel_radius_) {
        row.tail<4>() += weights;
      }
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
    Eigen::Matrix<double, 1, 12> along_row =
        Eigen::Matrix<double, 1, 12>::Zero();
    for (int i = 0; i < x.weights.rows(); ++i) {
      const int column = std::clamp(x.first_pixel + i, 0, image_.width - 1);
      along_row += image_.at(column, row) * x.weights.row(i);
    }
    // Grid points that are pixel centres, on a pixel along both axes, have the
    // shorter filters.
    const Orders between_x = along_row.head<4>();
    const Orders on_pixel_x = along_row.segment<4>(4);
    const auto across = y.weights.row(j);
    derivatives += across.head<4>().transpose() * (between_x + on_pixel_x) +
                   across.segment<4>(4).transpose() * between_x +
                   across.tail<4>().transpose() * along_row.tail<4>();
  }
  return derivatives;
}

}  // namespace curvix
