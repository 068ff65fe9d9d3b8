// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Points in space, found by where they are.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace curvix {

// A balanced k-d tree without nodes: the median of every range of `order_`, in
// the axis in which the range is longest, splits it. Suits points of any
// density, also many in one place.
class PointTree {
 public:
  // Points must be finite.
  explicit PointTree(std::vector<Eigen::Vector3d> points);

  // The points at most `radius` from `center`, in ascending order of index.
  std::vector<std::size_t> Within(const Eigen::Vector3d& center,
                                  double radius) const;

 private:
  struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  void Build(Range range);

  std::vector<Eigen::Vector3d> points_;
  std::vector<std::size_t> order_;
  std::vector<std::uint8_t> axes_;  // of the range whose median is here
};

}  // namespace curvix
