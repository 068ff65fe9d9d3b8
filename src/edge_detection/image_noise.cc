// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How noisy an image is.
#include "edge_detection/detect_view_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace curvix {
namespace {

using Mask = std::array<float, 5>;
constexpr Mask kSmooth = {1 / 16.f, 4 / 16.f, 6 / 16.f, 4 / 16.f, 1 / 16.f};
constexpr Mask kFirst = {-1 / 8.f, -2 / 8.f, 0, 2 / 8.f, 1 / 8.f};
constexpr Mask kSecond = {1 / 4.f, 0, -2 / 4.f, 0, 1 / 4.f};
// Standard deviation of the Laplacian in white noise of standard deviation 1:
// the root of the sum of the squares of its 25 weights,
// 2 |second|^2 |smooth|^2 + 2 (second . smooth)^2 = 65 / 256.
const double kLaplacianGain = std::sqrt(65.0 / 256);
// Of |x| for a normal x of standard deviation 1.
constexpr double kMedianOfAbsNormal = 0.6744897501960817;
constexpr float kBlack = 0.5f;
constexpr float kWhite = 254.5f;
constexpr double kEnoughSamples = 250000;

struct Sample {
  float steepness;  // squared gradient
  float laplacian;  // its size
};

// Five rows of an image, each column reduced to what samples need of it.
struct Columns {
  std::vector<float> smooth, first, second, low, high;
};

void Reduce(const float* rows, std::size_t width, Columns& columns) {
  columns.smooth.assign(width, 0);
  columns.first.assign(width, 0);
  columns.second.assign(width, 0);
  columns.low.assign(rows, rows + width);
  columns.high.assign(rows, rows + width);
  for (std::size_t j = 0; j < kSmooth.size(); ++j) {
    const float* row = rows + j * width;
    for (std::size_t x = 0; x < width; ++x) {
      columns.smooth[x] += kSmooth[j] * row[x];
      columns.first[x] += kFirst[j] * row[x];
      columns.second[x] += kSecond[j] * row[x];
      columns.low[x] = std::min(columns.low[x], row[x]);
      columns.high[x] = std::max(columns.high[x], row[x]);
    }
  }
}

float Apply(const Mask& mask, const float* values) {
  float sum = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) sum += mask[i] * values[i];
  return sum;
}

void AppendSamples(const Columns& columns,
                   std::size_t stride,
                   std::vector<Sample>& samples) {
  constexpr std::size_t kSize = kSmooth.size();
  for (std::size_t x = 0; x + kSize <= columns.low.size(); x += stride) {
    const float* low = &columns.low[x];
    const float* high = &columns.high[x];
    if (*std::min_element(low, low + kSize) < kBlack) continue;
    if (*std::max_element(high, high + kSize) > kWhite) continue;
    const float gx = Apply(kFirst, &columns.smooth[x]);
    const float gy = Apply(kSmooth, &columns.first[x]);
    const float laplacian =
        Apply(kSecond, &columns.smooth[x]) + Apply(kSmooth, &columns.second[x]);
    samples.push_back({gx * gx + gy * gy, std::abs(laplacian)});
  }
}

float MedianLaplacianOfFlatterHalf(std::vector<Sample> samples) {
  const auto half = static_cast<std::ptrdiff_t>((samples.size() + 1) / 2);
  const auto flat_end = samples.begin() + half;
  std::ranges::nth_element(samples, flat_end - 1, {}, &Sample::steepness);
  const auto median = samples.begin() + half / 2;
  std::ranges::nth_element(
      samples.begin(), median, flat_end, {}, &Sample::laplacian);
  return median->laplacian;
}

// How many pixels samples are apart along either axis: two, or more if enough
// are left. Then odd, for samples in all places of JPEG's blocks of 8 x 8.
std::size_t StrideFor(const GrayImage& image) {
  const double num_pixels = static_cast<double>(image.width) * image.height;
  const auto stride =
      static_cast<std::size_t>(std::sqrt(num_pixels / kEnoughSamples));
  return stride < 3 ? 2 : stride - (stride + 1) % 2;
}

}  // namespace

double EstimateNoise(const GrayImage& image) {
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  const std::size_t stride = StrideFor(image);
  std::vector<Sample> samples;
  samples.reserve((width / stride + 1) * (height / stride + 1));
  Columns columns;
  for (std::size_t y = 0; y + kSmooth.size() <= height; y += stride) {
    Reduce(&image.pixels[y * width], width, columns);
    AppendSamples(columns, stride, samples);
  }
  if (samples.empty()) return 0;
  const double sigma = MedianLaplacianOfFlatterHalf(std::move(samples)) /
                       (kLaplacianGain * kMedianOfAbsNormal);
  return std::sqrt(std::max(0.0, sigma * sigma - 1.0 / 12));
}

}  // namespace curvix
