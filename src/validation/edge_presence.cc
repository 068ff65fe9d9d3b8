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

EdgePresence::EdgePresence(const std::vector<Edge2d>& edges,
                           int width,
                           int height,
                           double reach_px,
                           double max_angle_rad)
    : columns_(static_cast<int>(width * kCellsPerPx) + 1),
      rows_(static_cast<int>(height * kCellsPerPx) + 1) {
  cells_.assign(
      static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
  const double reach = reach_px * (1 + 1e-6) + 1e-3;  // positions are rounded
  for (const Edge2d& edge : edges) {
    const std::uint16_t bins =
        BinsAround(static_cast<double>(edge.angle), max_angle_rad);
    const Eigen::Vector2d& x = edge.position;
    const int column_end = Cell(x.x() + reach, columns_);
    const int row_end = Cell(x.y() + reach, rows_);
    for (int row = Cell(x.y() - reach, rows_); row <= row_end; ++row) {
      for (int column = Cell(x.x() - reach, columns_); column <= column_end;
           ++column) {
        cells_[static_cast<std::size_t>(row) *
                   static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column)] |= bins;
      }
    }
  }
}

}  // namespace curvix
