// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Finds edges near a place in an image.
#pragma once

#include <curvix/edges.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace curvix {

// The one of `count` cells of size 1 that holds `place`, the nearest one beyond
// them.
inline int ClampedCell(double place, int count) {
  if (!(place > 0)) return 0;
  return place >= count ? count - 1 : static_cast<int>(place);
}

// An edge as the index keeps it: everything that a look-up compares.
struct IndexedEdge {
  Eigen::Vector2f position;  // pixels
  Eigen::Vector2f tangent;   // unit
  std::int32_t edge_idx = 0;
};

// Edges of one image in square buckets, each bucket in edge order. Building
// takes O(edges + buckets); a visit touches only the buckets that meet its
// rectangle.
class GridIndex {
 public:
  GridIndex() = default;
  // cell_size_px > 0. The grid spans the bounding box of the edges; where few
  // edges lie so far apart that this takes too many buckets, cells are larger.
  GridIndex(const std::vector<Edge2d>& edges, double cell_size_px);

  // Calls f(edge) for each edge in buckets that meet the axis-aligned rectangle
  // of half-widths `reach_px` around `center`: all edges inside it and some
  // around it; bucket by bucket in row order, always the same order.
  template <typename F>
  void VisitAround(const Eigen::Vector2d& center,
                   const Eigen::Vector2d& reach_px,
                   const F& f) const {
    if (edges_.empty()) return;
    const Eigen::Vector2d first = center - reach_px - origin_;
    const Eigen::Vector2d last = center + reach_px - origin_;
    const int column_begin = Cell(first.x(), columns_);
    const int column_end = Cell(last.x(), columns_);
    const int row_begin = Cell(first.y(), rows_);
    const int row_end = Cell(last.y(), rows_);
    for (int row = row_begin; row <= row_end; ++row) {
      const IndexedEdge* edge = BucketBegin(Bucket(column_begin, row));
      const IndexedEdge* end = BucketBegin(Bucket(column_end, row) + 1);
      for (; edge != end; ++edge) f(*edge);
    }
  }

  // The same of a square.
  template <typename F>
  void VisitAround(const Eigen::Vector2d& center,
                   double reach_px,
                   const F& f) const {
    VisitAround(center, Eigen::Vector2d::Constant(reach_px).eval(), f);
  }

  // Visits pairs of neighbouring edges: f(edge, begin, end) stands for the
  // pairs of `edge` with each edge in [begin, end). Every pair at most a cell
  // apart in x and in y is visited once, some pairs further apart, too.
  template <typename F>
  void VisitPairs(const F& f) const {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        const int left = column > 0 ? column - 1 : 0;
        const int right = column + 1 < columns_ ? column + 1 : column;
        const IndexedEdge* end = BucketBegin(Bucket(right, row) + 1);
        const IndexedEdge* edge = BucketBegin(Bucket(column, row));
        const IndexedEdge* last = BucketBegin(Bucket(column, row) + 1);
        for (; edge != last; ++edge) {
          f(*edge, edge + 1, end);
          if (row + 1 == rows_) continue;
          f(*edge,
            BucketBegin(Bucket(left, row + 1)),
            BucketBegin(Bucket(right, row + 1) + 1));
        }
      }
    }
  }

 private:
  // The bucket of an offset from the origin, clamped into the grid.
  int Cell(double offset, int count) const {
    return ClampedCell(offset * cells_per_px_, count);
  }
  std::size_t Bucket(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  const IndexedEdge* BucketBegin(std::size_t bucket) const {
    return edges_.data() + begins_[bucket];
  }

  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  double cells_per_px_ = 1;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::int32_t> begins_;  // first edge of each bucket, and the end
  std::vector<IndexedEdge> edges_;
};

}  // namespace curvix
