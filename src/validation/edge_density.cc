// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "validation/edge_density.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/angles.h"

namespace curvix {
namespace {

constexpr double kCellPx = 16;
constexpr int kNumBins = 12;  // of 15 degrees

int Clamp(double value, int count) {
  if (!(value > 0)) return 0;
  return value >= count ? count - 1 : static_cast<int>(value);
}

// Place on the circle of bins, in [0, kNumBins).
double TurnOf(double angle_rad) {
  const double turn = (WrapUndirected(angle_rad) / kPi + 0.5) * kNumBins;
  return turn < kNumBins ? turn : 0;
}

int BinOf(double angle_rad) { return Clamp(TurnOf(angle_rad), kNumBins); }

}  // namespace

EdgeDensity::EdgeDensity(const EdgeMap& map, int width, int height)
    : columns_(static_cast<int>(width / kCellPx) + 1),
      rows_(static_cast<int>(height / kCellPx) + 1),
      spacing_px_(map.spacing_px) {
  counts_.assign(static_cast<std::size_t>(columns_) *
                     static_cast<std::size_t>(rows_) * kNumBins,
                 0);
  for (const Edge2d& edge : map.edges) {
    const int column = Clamp(edge.position.x() / kCellPx, columns_);
    const int row = Clamp(edge.position.y() / kCellPx, rows_);
    std::uint16_t& count = counts_[static_cast<std::size_t>(
        (row * columns_ + column) * kNumBins +
        BinOf(static_cast<double>(edge.angle)))];
    if (count < std::numeric_limits<std::uint16_t>::max()) ++count;
  }
}

double EdgeDensity::Density(const Eigen::Vector2d& pixel,
                            double angle_rad) const {
  const int column = Clamp(pixel.x() / kCellPx, columns_);
  const int row = Clamp(pixel.y() / kCellPx, rows_);
  // One bin to either side of the angle: the own bin, and of the bins next to
  // it what is left of either side.
  const double turn = TurnOf(angle_rad);
  const int bin = BinOf(angle_rad);
  const double after = turn - bin;
  const int bin_before = (bin + kNumBins - 1) % kNumBins;
  const int bin_after = (bin + 1) % kNumBins;
  double num_edges = 0;
  int num_cells = 0;
  for (int r = std::max(0, row - 1); r <= std::min(rows_ - 1, row + 1); ++r) {
    for (int c = std::max(0, column - 1);
         c <= std::min(columns_ - 1, column + 1);
         ++c) {
      const std::uint16_t* counts =
          &counts_[static_cast<std::size_t>((r * columns_ + c) * kNumBins)];
      num_edges += counts[bin] + (1 - after) * counts[bin_before] +
                   after * counts[bin_after];
      ++num_cells;
    }
  }
  const double area = num_cells * kCellPx * kCellPx;
  return std::max(0.003, num_edges * spacing_px_ / area);
}

}  // namespace curvix
