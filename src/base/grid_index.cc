// SPDX-License-Identifier: BSD-3-Clause
#include "base/grid_index.h"

#include <cmath>

#include "base/check.h"

namespace curvix {
namespace {

constexpr double kFreeBuckets = 1 << 16;
constexpr double kBucketsPerEdge = 16;

}  // namespace

GridIndex::GridIndex(const std::vector<Edge2d>& edges, double cell_size_px)
    : cells_per_px_(1 / cell_size_px) {
  CURVIX_CHECK(cell_size_px > 0, "cell_size_px is " << cell_size_px);
  if (edges.empty()) return;
  origin_ = edges.front().position;
  Eigen::Vector2d end = origin_;
  for (const Edge2d& edge : edges) {
    origin_ = origin_.cwiseMin(edge.position);
    end = end.cwiseMax(edge.position);
  }
  const Eigen::Vector2d extent = end - origin_;
  const double most =
      kFreeBuckets + kBucketsPerEdge * static_cast<double>(edges.size());
  const auto count = [&](double length) { return length * cells_per_px_ + 1; };
  while (count(extent.x()) * count(extent.y()) > most) cells_per_px_ /= 2;
  columns_ = static_cast<int>(count(extent.x()));
  rows_ = static_cast<int>(count(extent.y()));

  // Counting sort by bucket keeps the edge order inside each bucket.
  const auto bucket_of = [&](const Edge2d& edge) {
    return Bucket(Cell(edge.position.x() - origin_.x(), columns_),
                  Cell(edge.position.y() - origin_.y(), rows_));
  };
  begins_.assign(Bucket(0, rows_) + 1, 0);
  for (const Edge2d& edge : edges) ++begins_[bucket_of(edge) + 1];
  for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  std::vector<std::int32_t> next(begins_.begin(), begins_.end() - 1);
  edges_.resize(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    IndexedEdge& slot =
        edges_[static_cast<std::size_t>(next[bucket_of(edges[i])]++)];
    slot.position = edges[i].position.cast<float>();
    slot.tangent = {std::cos(edges[i].angle), std::sin(edges[i].angle)};
    slot.edge_idx = static_cast<std::int32_t>(i);
  }
}

}  // namespace curvix
