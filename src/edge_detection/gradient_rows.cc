// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/gradient_rows.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/wide_vectors.h"
#include "edge_detection/gaussian_derivatives.h"

namespace curvix {
namespace {

constexpr int kMinTileSide = 8;

struct Span {
  float low;
  float high;

  void Join(const Span& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
};

// One row of tiles.
using Spans = std::vector<Span>;

// The lowest and the highest pixel of each tile in rows [begin, end).
Spans SpansOfTiles(const GrayImage& image, int begin, int end, int side) {
  const auto width = static_cast<std::size_t>(image.width);
  const float* pixels =
      image.pixels.data() + static_cast<std::size_t>(begin) * width;
  std::vector<float> low(pixels, pixels + width), high = low;
  for (int y = begin + 1; y < end; ++y) {
    pixels += width;
    for (std::size_t x = 0; x < width; ++x) {
      low[x] = std::min(low[x], pixels[x]);
      high[x] = std::max(high[x], pixels[x]);
    }
  }
  Spans spans;
  const auto step = static_cast<std::size_t>(side);
  for (std::size_t x = 0; x < width; x += step) {
    const std::size_t x_end = std::min(x + step, width);
    Span span{low[x], high[x]};
    for (std::size_t i = x + 1; i < x_end; ++i) span.Join({low[i], high[i]});
    spans.push_back(span);
  }
  return spans;
}

// The span of each tile and its neighbours along the row.
Spans JoinNeighbors(const Spans& spans) {
  Spans joined = spans;
  for (std::size_t i = 1; i < spans.size(); ++i) {
    joined[i].Join(spans[i - 1]);
    joined[i - 1].Join(spans[i]);
  }
  return joined;
}

std::vector<PixelRun> RunsOf(const Spans& spans,
                             float max_span,
                             int side,
                             int width) {
  std::vector<PixelRun> runs;
  int begin = 0;
  for (const Span& span : spans) {
    const int end = std::min(begin + side, width);
    const bool is_steep = !(span.high - span.low <= max_span);
    const bool goes_on = !runs.empty() && runs.back().end == begin;
    if (is_steep && goes_on) runs.back().end = end;
    if (is_steep && !goes_on) runs.push_back({begin, end});
    begin = end;
  }
  return runs;
}

}  // namespace

SteepTiles::SteepTiles(const GrayImage& image, int reach_px, float max_span)
    : side_(std::max(kMinTileSide, reach_px)) {
  std::vector<Spans> rows;
  for (int y = 0; y < image.height; y += side_) {
    const int end = std::min(y + side_, image.height);
    rows.push_back(JoinNeighbors(SpansOfTiles(image, y, end, side_)));
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    Spans joined = rows[row];
    for (std::size_t i = 0; i < joined.size(); ++i) {
      if (row > 0) joined[i].Join(rows[row - 1][i]);
      if (row + 1 < rows.size()) joined[i].Join(rows[row + 1][i]);
    }
    runs_.push_back(RunsOf(joined, max_span, side_, image.width));
  }
}

GradientRows::GradientRows(const GrayImage& image, const DetectionScale& scale)
    : image_(image),
      samples_per_px_(scale.samples_per_px),
      radius_(GaussianRadius(scale.sigma_px)) {
  CURVIX_CHECK(image.width > 0 && image.height > 0, "the image is empty");
  double max_smooth = 0, max_derive = 0;
  for (int phase = 0; phase < 2; ++phase) {
    Taps& taps = taps_[static_cast<std::size_t>(phase)];
    double smooth = 0, derive = 0;
    for (int k = 0; k <= radius_; ++k) {
      const double distance = k + phase / 2.0;
      const auto g = GaussianDerivatives(-distance, scale.sigma_px);
      const double share = distance == 0 ? 0.5 : 1.0;
      taps.smooth.push_back(static_cast<float>(share * g[0]));
      taps.derive.push_back(static_cast<float>(g[1]));
      smooth += 2 * share * g[0];
      derive += g[1];
    }
    max_smooth = std::max(max_smooth, smooth);
    max_derive = std::max(max_derive, derive);
  }
  max_gain_ = std::sqrt(2.0) * max_smooth * max_derive;
  const auto width = static_cast<std::size_t>(image.width);
  const auto pad = static_cast<std::size_t>(radius_ + 1);
  smooth_.resize(width + 2 * pad);
  derived_.resize(width + 2 * pad);
  for (std::vector<float>& phase : phases_) phase.resize(width);
}

void GradientRows::Compute(int grid_row,
                           const PixelRun& run,
                           GradientRow& row) {
  CURVIX_CHECK(grid_row >= 0 && grid_row < grid_height(), grid_row);
  CURVIX_CHECK(run.begin >= 0 && run.begin < run.end, run.begin);
  CURVIX_CHECK(run.end <= image_.width, run.end);
  const auto n = static_cast<std::size_t>(samples_per_px_);
  const std::size_t size = n * static_cast<std::size_t>(image_.width);
  row.x.resize(size);
  row.y.resize(size);
  row.magnitude.resize(size);
  FilterColumns(grid_row, run);
  FilterRow(smooth_, &Taps::derive, -1, run, row.x);
  FilterRow(derived_, &Taps::smooth, 1, run, row.y);
  const float* x = row.x.data();
  const float* y = row.y.data();
  float* magnitude = row.magnitude.data();
  const std::size_t end = n * static_cast<std::size_t>(run.end);
  for (auto i = n * static_cast<std::size_t>(run.begin); i < end; ++i) {
    magnitude[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
  }
}

// out[i] = sum over k of weights[k] * (pairs[k].a[i] + sign * pairs[k].b[i]).
// Block by block, so that sums stay in registers.
CURVIX_WIDE_VECTORS
void GradientRows::SumPairs(const std::vector<Pair>& pairs,
                            const std::vector<float>& weights,
                            float sign,
                            std::size_t n,
                            float* out) {
  constexpr std::size_t kBlock = 16;
  const auto sum_block = [&](std::size_t begin, std::size_t size) {
    float sums[kBlock] = {};
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const float* a = pairs[k].a + begin;
      const float* b = pairs[k].b + begin;
      const float weight_a = weights[k];
      const float weight_b = weight_a * sign;
      for (std::size_t i = 0; i < size; ++i) {
        sums[i] += weight_a * a[i] + weight_b * b[i];
      }
    }
    for (std::size_t i = 0; i < size; ++i) out[begin + i] = sums[i];
  };
  std::size_t begin = 0;
  for (; begin + kBlock <= n; begin += kBlock) sum_block(begin, kBlock);
  sum_block(begin, n - begin);
}

void GradientRows::FilterColumns(int grid_row, const PixelRun& run) {
  const int phase = grid_row % samples_per_px_;
  const int y = grid_row / samples_per_px_;
  const int begin = std::max(run.begin - reach_px(), 0);
  const int end = std::min(run.end + reach_px(), image_.width);
  const auto pixels = [&](int row) {
    const auto inside =
        static_cast<std::size_t>(std::clamp(row, 0, image_.height - 1));
    return image_.pixels.data() +
           inside * static_cast<std::size_t>(image_.width) + begin;
  };
  pairs_.clear();
  for (int k = 0; k <= radius_; ++k) {
    pairs_.push_back({pixels(y + phase + k), pixels(y - k)});
  }
  const Taps& taps = taps_[static_cast<std::size_t>(phase)];
  const auto pad = static_cast<std::size_t>(reach_px());
  const std::size_t first = pad + static_cast<std::size_t>(begin);
  const auto n = static_cast<std::size_t>(end - begin);
  SumPairs(pairs_, taps.smooth, 1, n, &smooth_[first]);
  SumPairs(pairs_, taps.derive, -1, n, &derived_[first]);
  for (std::vector<float>* padded : {&smooth_, &derived_}) {
    const float left = (*padded)[first];
    const float right = (*padded)[first + n - 1];
    if (begin == 0) std::fill_n(padded->begin(), pad, left);
    if (end == image_.width) std::fill_n(padded->rbegin(), pad, right);
  }
}

void GradientRows::FilterRow(const std::vector<float>& padded,
                             const std::vector<float> Taps::*weights,
                             float sign,
                             const PixelRun& run,
                             std::vector<float>& out) {
  const auto begin = static_cast<std::size_t>(run.begin);
  const auto n = static_cast<std::size_t>(run.end - run.begin);
  const float* centre =
      padded.data() + static_cast<std::size_t>(reach_px()) + begin;
  const auto num_phases = static_cast<std::size_t>(samples_per_px_);
  for (std::size_t phase = 0; phase < num_phases; ++phase) {
    const std::vector<float>& taps = taps_[phase].*weights;
    pairs_.clear();
    for (std::size_t k = 0; k < taps.size(); ++k) {
      pairs_.push_back({centre + phase + k, centre - k});
    }
    SumPairs(pairs_, taps, sign, n, phases_[phase].data());
  }
  if (num_phases == 1) {
    std::copy_n(phases_[0].data(), n, &out[begin]);
    return;
  }
  const float* on_pixels = phases_[0].data();
  const float* between = phases_[1].data();
  float* points = &out[2 * begin];
  for (std::size_t i = 0; i < n; ++i) {
    points[2 * i] = on_pixels[i];
    points[2 * i + 1] = between[i];
  }
}

}  // namespace curvix
