// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. The gradient of an image at half-pixel sampling.
#include "edge_detection/gradient_rows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/check.h"
#include "edge_detection/gaussian_derivatives.h"

namespace curvix {
namespace {

// out[i] += weight * (a[i] + sign * b[i]).
void AddPairs(const float* a,
              const float* b,
              float weight,
              float sign,
              std::size_t n,
              float* out) {
  const float weight_b = weight * sign;
  for (std::size_t i = 0; i < n; ++i) out[i] += weight * a[i] + weight_b * b[i];
}

void ReplicateEnds(std::size_t pad, std::vector<float>& padded) {
  const auto size = static_cast<std::ptrdiff_t>(padded.size());
  const auto border = static_cast<std::ptrdiff_t>(pad);
  std::fill_n(padded.begin(), border, padded[pad]);
  std::fill(padded.begin() + (size - border),
            padded.end(),
            padded[padded.size() - pad - 1]);
}

}  // namespace

GradientRows::GradientRows(const GrayImage& image, double sigma_px)
    : image_(image), radius_(GaussianRadius(sigma_px)) {
  CURVIX_CHECK(image.width > 0 && image.height > 0, "the image is empty");
  for (int phase = 0; phase < 2; ++phase) {
    Taps& taps = taps_[static_cast<std::size_t>(phase)];
    for (int k = 0; k <= radius_; ++k) {
      const double distance = k + phase / 2.0;
      const auto g = GaussianDerivatives(-distance, sigma_px);
      const double share = distance == 0 ? 0.5 : 1.0;
      taps.smooth.push_back(static_cast<float>(share * g[0]));
      taps.derive.push_back(static_cast<float>(g[1]));
    }
  }
  const auto width = static_cast<std::size_t>(image.width);
  const auto pad = static_cast<std::size_t>(radius_ + 1);
  smooth_.resize(width + 2 * pad);
  derived_.resize(width + 2 * pad);
  for (std::vector<float>& phase : phases_) phase.resize(width);
}

void GradientRows::Compute(int grid_row, GradientRow& row) {
  CURVIX_CHECK(grid_row >= 0 && grid_row < grid_height(), grid_row);
  const auto n = static_cast<std::size_t>(grid_width());
  row.x.resize(n);
  row.y.resize(n);
  row.magnitude.resize(n);
  FilterColumns(grid_row);
  FilterRow(smooth_, &Taps::derive, -1, row.x);
  FilterRow(derived_, &Taps::smooth, 1, row.y);
  for (std::size_t i = 0; i < n; ++i) {
    row.magnitude[i] = std::sqrt(row.x[i] * row.x[i] + row.y[i] * row.y[i]);
  }
}

void GradientRows::FilterColumns(int grid_row) {
  const int phase = grid_row % 2;
  const int y = grid_row / 2;
  const Taps& taps = taps_[static_cast<std::size_t>(phase)];
  const auto width = static_cast<std::size_t>(image_.width);
  const auto pad = static_cast<std::size_t>(radius_ + 1);
  const auto pixels = [&](int row) {
    const int inside = std::clamp(row, 0, image_.height - 1);
    return image_.pixels.data() + static_cast<std::size_t>(inside) * width;
  };
  std::fill(smooth_.begin(), smooth_.end(), 0.0f);
  std::fill(derived_.begin(), derived_.end(), 0.0f);
  for (int k = 0; k <= radius_; ++k) {
    const float* below = pixels(y + phase + k);
    const float* above = pixels(y - k);
    const auto tap = static_cast<std::size_t>(k);
    AddPairs(below, above, taps.smooth[tap], 1, width, &smooth_[pad]);
    AddPairs(below, above, taps.derive[tap], -1, width, &derived_[pad]);
  }
  ReplicateEnds(pad, smooth_);
  ReplicateEnds(pad, derived_);
}

void GradientRows::FilterRow(const std::vector<float>& padded,
                             const std::vector<float> Taps::*weights,
                             float sign,
                             std::vector<float>& out) {
  const auto width = static_cast<std::size_t>(image_.width);
  const auto pad = static_cast<std::size_t>(radius_ + 1);
  for (std::size_t phase = 0; phase < 2; ++phase) {
    std::vector<float>& sums = phases_[phase];
    std::fill(sums.begin(), sums.end(), 0.0f);
    const std::vector<float>& taps = taps_[phase].*weights;
    for (std::size_t k = 0; k < taps.size(); ++k) {
      const float* right = padded.data() + pad + phase + k;
      const float* left = padded.data() + pad - k;
      AddPairs(right, left, taps[k], sign, width, sums.data());
    }
  }
  const float* on_pixels = phases_[0].data();
  const float* between = phases_[1].data();
  for (std::size_t i = 0; i + 1 < width; ++i) {
    out[2 * i] = on_pixels[i];
    out[2 * i + 1] = between[i];
  }
  out[2 * width - 2] = on_pixels[width - 1];
}

}  // namespace curvix
