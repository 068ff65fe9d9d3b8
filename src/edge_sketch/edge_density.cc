// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/edge_density.h"

#include <algorithm>
#include <limits>

#include "base/angles.h"

namespace curvix {
namespace {

constexpr double kCellPx = 16;
constexpr int kNumBins = 12;  // of 15 degrees

// Place on the circle of bins, in [0, kNumBins).
double TurnOf(double angle_rad) {
  const double turn = (WrapUndirected(angle_rad) / kPi + 0.5) * kNumBins;
  return turn < kNumBins ? turn : 0;
}

}  // namespace

EdgeDensity::EdgeDensity(const EdgeMap& map,
                         int width,
                         int height,
                         double margin_px)
    : columns_(static_cast<int>((width + 2 * margin_px) / kCellPx) + 1),
      rows_(static_cast<int>((height + 2 * margin_px) / kCellPx) + 1),
      margin_px_(margin_px),
      spacing_px_(map.spacing_px) {
  counts_.assign(static_cast<std::size_t>(columns_) *
                     static_cast<std::size_t>(rows_) * kNumBins,
                 0);
  for (const Edge2d& edge : map.edges) {
    const int column = Cell(edge.position.x(), columns_);
    const int row = Cell(edge.position.y(), rows_);
    std::uint16_t& count = counts_[static_cast<std::size_t>(
        (row * columns_ + column) * kNumBins +
        ClampedCell(TurnOf(static_cast<double>(edge.angle)), kNumBins))];
    if (count < std::numeric_limits<std::uint16_t>::max()) ++count;
  }
}

int EdgeDensity::Cell(double place, int count) const {
  return ClampedCell((place + margin_px_) / kCellPx, count);
}

double EdgeDensity::Density(const Eigen::Vector2d& pixel,
                            double angle_rad) const {
  const int column = Cell(pixel.x(), columns_);
  const int row = Cell(pixel.y(), rows_);
  // One bin to either side of the angle: the own bin, and of the bins next to
  // it what is left of either side.
  const double turn = TurnOf(angle_rad);
  const int bin = ClampedCell(turn, kNumBins);
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

// The bins of all directions within max_angle_rad, and a little more, since
// indexed tangents are rounded.
std::uint16_t EdgePresence::BinsAround(double angle_rad, double max_angle_rad) {
  constexpr double kRounding = 1e-4;
  const double half_width = max_angle_rad + kRounding;
  if (half_width >= kPi / 2) return 0xffff;
  const auto bin_of = [](double angle) {
    return Bin({std::cos(angle), std::sin(angle)});
  };
  const int last = bin_of(angle_rad + half_width);
  // Less than a half turn apart, but perhaps in one bin from two sides.
  const int first = bin_of(angle_rad - half_width);
  if (first == last && half_width > kPi / 4) return 0xffff;
  unsigned bins = 1U << last;
  for (int bin = first; bin != last; bin = (bin + 1) % kNumBins) {
    bins |= 1U << bin;
  }
  return static_cast<std::uint16_t>(bins);
}

std::uint16_t& EdgePresence::CellAt(int column, int row) {
  std::uint32_t& tile = tiles_[TileOf(column, row)];
  if (tile == 0) {
    tile = static_cast<std::uint32_t>(cells_.size() / kCellsPerTile);
    cells_.resize(cells_.size() + kCellsPerTile, 0);
  }
  return cells_[FirstCell(tile) + CellInTile(column, row)];
}

EdgePresence::EdgePresence(const std::vector<Edge2d>& edges,
                           int width,
                           int height,
                           double normal_px,
                           double tangential_px,
                           double max_angle_rad)
    : columns_(static_cast<int>(width * kCellsPerPx) + 1),
      rows_(static_cast<int>(height * kCellsPerPx) + 1),
      tile_columns_((columns_ - 1) / kTileSide + 1),
      tiles_(TileOf(columns_ - 1, rows_ - 1) + 1, 0),
      cells_(kCellsPerTile, 0) {
  constexpr double kSidePx = 1 / kCellsPerPx;
  constexpr double kRoundingPx = 1e-3;
  for (const Edge2d& edge : edges) {
    const std::uint16_t bins =
        BinsAround(static_cast<double>(edge.angle), max_angle_rad);
    const Eigen::Vector2d& x = edge.position;
    const Eigen::Vector2d tangent(std::cos(edge.angle), std::sin(edge.angle));
    const Eigen::Vector2d normal(-tangent.y(), tangent.x());
    const Eigen::Vector2d reach = normal_px * normal.cwiseAbs() +
                                  tangential_px * tangent.cwiseAbs() +
                                  Eigen::Vector2d::Constant(kRoundingPx);
    // Half the extent of a cell along any two directions at right angles.
    const double half_cell = kSidePx / 2 * tangent.lpNorm<1>() + kRoundingPx;
    const int column_end = Cell(x.x() + reach.x(), columns_);
    const int row_end = Cell(x.y() + reach.y(), rows_);
    for (int row = Cell(x.y() - reach.y(), rows_); row <= row_end; ++row) {
      for (int column = Cell(x.x() - reach.x(), columns_); column <= column_end;
           ++column) {
        const Eigen::Vector2d offset =
            kSidePx * Eigen::Vector2d(column + 0.5, row + 0.5) - x;
        const bool is_near =
            std::abs(offset.dot(normal)) <= normal_px + half_cell &&
            std::abs(offset.dot(tangent)) <= tangential_px + half_cell;
        // Cells at the border stand for all beyond it, too.
        if (is_near || IsAtBorder(column, row)) CellAt(column, row) |= bins;
      }
    }
  }
  cells_.shrink_to_fit();
}

}  // namespace curvix
