// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/steep_tiles.h"

#include <algorithm>
#include <cstdint>

namespace curvix {
namespace {

constexpr int kMinSide = 8;

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
    : side_(std::max(kMinSide, reach_px)) {
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

}  // namespace curvix
