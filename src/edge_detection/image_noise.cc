// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). How noisy an image is.
#include "edge_detection/image_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace curvix {
namespace {

constexpr float kBlack = 0.5f;
constexpr float kWhite = 254.5f;
// Of |x| for a normal x of standard deviation 1.
constexpr double kMedianOfAbsNormal = 0.6744897501960817;
// Root of the sum of the squares of the mask's weights.
constexpr double kMaskGain = 6;

struct Sample {
  float steepness;  // squared Sobel gradient
  float response;   // |mask|
};

// Three pixels side by side in three rows.
Sample SampleAt(const float* above, const float* middle, const float* below) {
  const float left = above[0] + 2 * middle[0] + below[0];
  const float right = above[2] + 2 * middle[2] + below[2];
  const float top = above[0] + 2 * above[1] + above[2];
  const float bottom = below[0] + 2 * below[1] + below[2];
  const float response = above[0] - 2 * above[1] + above[2] -
                         2 * (middle[0] - 2 * middle[1] + middle[2]) +
                         below[0] - 2 * below[1] + below[2];
  const float gx = right - left;
  const float gy = bottom - top;
  return {gx * gx + gy * gy, std::abs(response)};
}

bool IsClipped(const float* three) {
  const auto [low, high] = std::minmax({three[0], three[1], three[2]});
  return low < kBlack || high > kWhite;
}

std::vector<Sample> CollectSamples(const GrayImage& image) {
  std::vector<Sample> samples;
  const auto width = static_cast<std::size_t>(image.width);
  for (int y = 1; y + 1 < image.height; ++y) {
    const float* middle =
        image.pixels.data() + static_cast<std::size_t>(y) * width;
    for (std::size_t x = 0; x + 2 < width; ++x) {
      const float* m = middle + x;
      const float* a = m - width;
      const float* b = m + width;
      if (IsClipped(a) || IsClipped(m) || IsClipped(b)) continue;
      samples.push_back(SampleAt(a, m, b));
    }
  }
  return samples;
}

}  // namespace

double EstimateNoise(const GrayImage& image) {
  if (image.width < 3 || image.height < 3) return 0;
  std::vector<Sample> samples = CollectSamples(image);
  if (samples.empty()) return 0;
  const auto quarter =
      samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 4);
  std::nth_element(samples.begin(),
                   quarter,
                   samples.end(),
                   [](const Sample& a, const Sample& b) {
                     return a.steepness < b.steepness;
                   });
  const auto flat_end = quarter + 1;
  const auto median = samples.begin() + (flat_end - samples.begin()) / 2;
  std::nth_element(
      samples.begin(), median, flat_end, [](const Sample& a, const Sample& b) {
        return a.response < b.response;
      });
  const double sigma = median->response / (kMaskGain * kMedianOfAbsNormal);
  return std::sqrt(std::max(0.0, sigma * sigma - 1.0 / 12));
}

}  // namespace curvix
