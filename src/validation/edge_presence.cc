// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "validation/edge_presence.h"

#include "base/angles.h"

namespace curvix {

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
  constexpr double kCellPx = 1 / kCellsPerPx;
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
    const double half_cell = kCellPx / 2 * tangent.lpNorm<1>() + kRoundingPx;
    const int column_end = Cell(x.x() + reach.x(), columns_);
    const int row_end = Cell(x.y() + reach.y(), rows_);
    for (int row = Cell(x.y() - reach.y(), rows_); row <= row_end; ++row) {
      for (int column = Cell(x.x() - reach.x(), columns_); column <= column_end;
           ++column) {
        const Eigen::Vector2d offset =
            kCellPx * Eigen::Vector2d(column + 0.5, row + 0.5) - x;
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
