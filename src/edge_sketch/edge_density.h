// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The density of edges, and a map of places without
// edges.
#pragma once

#include <curvix/edges.h>
#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/grid_index.h"

namespace curvix {

// Counts of edges by place (square cells) and orientation (bins of 15 degrees).
class EdgeDensity {
 public:
  EdgeDensity() = default;
  // The image reaches `margin_px` beyond its size (PosedView::margin_px).
  EdgeDensity(const EdgeMap& map, int width, int height, double margin_px = 0);

  // Edges of like direction (within 15 degrees of `angle_rad`) per pixel across
  // them, around `pixel`: the length of their contours in the surroundings
  // (about 48 x 48 pixels) over the area. At least 0.003, one contour in 330
  // pixels.
  double Density(const Eigen::Vector2d& pixel, double angle_rad) const;

 private:
  int Cell(double place, int count) const;

  int columns_ = 0;
  int rows_ = 0;
  double margin_px_ = 0;
  double spacing_px_ = 0.5;            // of edges along a contour
  std::vector<std::uint16_t> counts_;  // [row][column][bin], saturating
};

// One bit for each place (cells of 2 x 2 pixels) and direction (16 bins) where
// a search would find an edge within its reach. Two bytes per cell of the tiles
// (8 x 8 cells) that have any: a cheap early rejection before the search for
// the nearest edge.
class EdgePresence {
 public:
  // Empty: MayHave() is always true.
  EdgePresence() = default;
  // For places up to normal_px from an edge across its tangent and
  // tangential_px along it (> 0), and up to max_angle_rad off in direction, in
  // an image of `width` x `height`.
  EdgePresence(const std::vector<Edge2d>& edges,
               int width,
               int height,
               double normal_px,
               double tangential_px,
               double max_angle_rad);

  // False only if no edge is within reach of `pixel` and has a direction like
  // `tangent` (finite, not zero, sign-free).
  bool MayHave(const Eigen::Vector2d& pixel,
               const Eigen::Vector2d& tangent) const {
    if (cells_.empty()) return true;
    const int column = Cell(pixel.x(), columns_);
    const int row = Cell(pixel.y(), rows_);
    const std::size_t cell =
        FirstCell(tiles_[TileOf(column, row)]) + CellInTile(column, row);
    return (cells_[cell] >> Bin(tangent)) & 1;
  }

 private:
  static constexpr double kCellsPerPx = 0.5;
  static constexpr int kNumBins = 16;
  static constexpr int kTileSide = 8;  // cells
  static constexpr std::size_t kCellsPerTile = kTileSide * kTileSide;

  static int Cell(double place, int count) {
    return ClampedCell(place * kCellsPerPx, count);
  }
  // Monotonic in the angle of the line: 0 to 2 for a half turn.
  static double DiamondAngle(const Eigen::Vector2d& t) {
    const double share = t.x() / (std::abs(t.x()) + std::abs(t.y()));
    return t.y() < 0 || (t.y() == 0 && t.x() < 0) ? 1 + share : 1 - share;
  }
  static int Bin(const Eigen::Vector2d& tangent) {
    const int bin = static_cast<int>(DiamondAngle(tangent) * kNumBins / 2);
    return bin < kNumBins ? bin : kNumBins - 1;
  }
  static std::uint16_t BinsAround(double angle_rad, double max_angle_rad);

  std::size_t TileOf(int column, int row) const {
    return static_cast<std::size_t>(row / kTileSide) *
               static_cast<std::size_t>(tile_columns_) +
           static_cast<std::size_t>(column / kTileSide);
  }
  static std::size_t CellInTile(int column, int row) {
    return static_cast<std::size_t>(row % kTileSide * kTileSide +
                                    column % kTileSide);
  }
  static std::size_t FirstCell(std::uint32_t tile) {
    return tile * kCellsPerTile;
  }
  // The cell, for writing; its tile is made if there is none.
  std::uint16_t& CellAt(int column, int row);
  bool IsAtBorder(int column, int row) const {
    return column == 0 || row == 0 || column == columns_ - 1 ||
           row == rows_ - 1;
  }

  int columns_ = 0;
  int rows_ = 0;
  int tile_columns_ = 0;
  std::vector<std::uint32_t> tiles_;  // index in cells_; 0: all bits are 0
  std::vector<std::uint16_t> cells_;  // tile by tile, first that without bits
};

}  // namespace curvix
