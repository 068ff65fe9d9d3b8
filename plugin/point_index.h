// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Nearest neighbours among points in space.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

namespace curvix {

// A kd-tree over at least one point. Queries are const and thread-safe.
class PointIndex {
 public:
  struct Neighbor {
    std::size_t index = 0;
    double distance = 0;  // in the unit of the points
  };

  explicit PointIndex(std::vector<Eigen::Vector3d> points);
  ~PointIndex();

  // The nearest point; any one of them if several are equally near.
  Neighbor Nearest(const Eigen::Vector3d& query) const;

  // All points within `radius`, the sphere included, ascending by index.
  std::vector<std::size_t> Within(const Eigen::Vector3d& query,
                                  double radius) const;

 private:
  class Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace curvix
