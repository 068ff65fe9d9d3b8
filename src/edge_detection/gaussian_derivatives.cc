// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. Gaussian derivative filters.
#include "edge_detection/gaussian_derivatives.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"

namespace curvix {
namespace {

// Weights of the samples at -1, 0, 1, 2 for the value at t in [0, 1].
Eigen::Array4d CubicWeights(double t) {
  return {((-0.5 * t + 1) * t - 0.5) * t,
          (1.5 * t - 2.5) * t * t + 1,
          ((-1.5 * t + 2) * t + 0.5) * t,
          (0.5 * t - 0.5) * t * t};
}

// How far the outermost pixels of a filter are from some of the four grid
// points, beyond the reach of the Gaussian: half pixels.
constexpr int kPadding = 3;

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
    : image_(image), radius_(GaussianRadius(sigma_px)) {
  const int reach = 2 * radius_ + 1;
  const int near_reach = 2 * PixelFilterRadius(sigma_px);
  for (int half_pixels = -reach - kPadding; half_pixels <= reach + kPadding;
       ++half_pixels) {
    const auto g = GaussianDerivatives(half_pixels / 2.0, sigma_px);
    const Orders orders = Eigen::Array4d(g[0], g[1], g[2], g[3]).cast<float>();
    const int distance = std::abs(half_pixels);
    table_.push_back(distance <= reach ? orders : Orders::Zero());
    near_table_.push_back(distance <= near_reach ? orders : Orders::Zero());
  }
  const auto size = static_cast<std::size_t>(2 * radius_ + 3);
  x_.resize(size);
  y_.resize(size);
}

void ImageDerivatives::SetFilter(double position,
                                 int num_pixels,
                                 Filter& filter) const {
  // On the half-pixel grid, pixel i is at 2 * i.
  const double on_grid = 2 * position - 1;
  const int cell = static_cast<int>(std::floor(on_grid));
  const Eigen::Array4f cubic = CubicWeights(on_grid - cell).cast<float>();
  int pixel = ((cell + 1) >> 1) - radius_ - 1;
  // The first of the four grid points around the position, from this pixel. Of
  // these every other one is on a pixel.
  int half_pixels = cell - 1 - 2 * pixel;
  const int between = half_pixels % 2 == 0 ? 1 : 0;
  const int on_pixel = 1 - between;
  for (Weights& weights : filter) {
    const auto first =
        static_cast<std::size_t>(half_pixels + 2 * radius_ + 1 + kPadding);
    const auto sum = [&](const std::vector<Orders>& table, int k) -> Orders {
      const Orders* points = &table[first];
      return cubic[k] * points[k] + cubic[k + 2] * points[k + 2];
    };
    weights.pixel = std::clamp(pixel, 0, num_pixels - 1);
    weights.between = sum(table_, between);
    weights.on_pixel = sum(table_, on_pixel);
    weights.near_pixel = sum(near_table_, on_pixel);
    ++pixel;
    half_pixels -= 2;
  }
}

ImageDerivatives::Sums ImageDerivatives::AlongRow(int row) const {
  const float* pixels =
      image_.pixels.data() + static_cast<std::ptrdiff_t>(row) * image_.width;
  Sums sum{Orders::Zero(), Orders::Zero(), Orders::Zero()};
  for (const Weights& weights : x_) {
    const float value = pixels[weights.pixel];
    sum.between += value * weights.between;
    sum.on_pixel += value * weights.on_pixel;
    sum.near_pixel += value * weights.near_pixel;
  }
  return sum;
}

Eigen::Matrix4d ImageDerivatives::At(const Eigen::Vector2d& position) {
  SetFilter(position.x(), image_.width, x_);
  SetFilter(position.y(), image_.height, y_);
  Eigen::Array44f derivatives = Eigen::Array44f::Zero();  // column: order in x
  for (const Weights& across : y_) {
    const Sums along = AlongRow(across.pixel);
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
