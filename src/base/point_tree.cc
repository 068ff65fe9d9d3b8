// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "base/point_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace curvix {

PointTree::PointTree(std::vector<Eigen::Vector3d> points)
    : points_(std::move(points)),
      order_(points_.size()),
      axes_(points_.size(), 0) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  Build({0, order_.size()});
}

void PointTree::Build(Range range) {
  if (range.begin >= range.end) return;
  Eigen::Vector3d low = points_[order_[range.begin]];
  Eigen::Vector3d high = low;
  for (std::size_t k = range.begin; k < range.end; ++k) {
    low = low.cwiseMin(points_[order_[k]]);
    high = high.cwiseMax(points_[order_[k]]);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t middle = range.begin + (range.end - range.begin) / 2;
  const auto at = [&](std::size_t k) {
    return order_.begin() + static_cast<std::ptrdiff_t>(k);
  };
  std::nth_element(
      at(range.begin), at(middle), at(range.end), [&](auto a, auto b) {
        return std::pair(points_[a][axis], a) < std::pair(points_[b][axis], b);
      });
  axes_[middle] = static_cast<std::uint8_t>(axis);
  Build({range.begin, middle});
  Build({middle + 1, range.end});
}

std::vector<std::size_t> PointTree::Within(const Eigen::Vector3d& center,
                                           double radius) const {
  std::vector<std::size_t> found;
  std::vector<Range> pending = {{0, order_.size()}};
  while (!pending.empty()) {
    const Range range = pending.back();
    pending.pop_back();
    if (range.begin >= range.end) continue;
    const std::size_t middle = range.begin + (range.end - range.begin) / 2;
    const Eigen::Vector3d& point = points_[order_[middle]];
    if ((point - center).norm() <= radius) found.push_back(order_[middle]);
    const double beyond = center[axes_[middle]] - point[axes_[middle]];
    if (beyond <= radius) pending.push_back({range.begin, middle});
    if (beyond >= -radius) pending.push_back({middle + 1, range.end});
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace curvix
