// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Points in space, found by where they are.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

namespace curvix {

// A k-d tree over finite points. Queries may run on several threads.
class PointTree {
 public:
  struct Neighbor {
    std::size_t index = 0;
    double distance = 0;  // in the unit of the points
  };

  explicit PointTree(std::vector<Eigen::Vector3d> points);
  ~PointTree();

  // The nearest point; any one of them if several are equally near. There must
  // be a point.
  Neighbor Nearest(const Eigen::Vector3d& query) const;

  // The points at most `radius` from `center`, in ascending order of index.
  std::vector<std::size_t> Within(const Eigen::Vector3d& center,
                                  double radius) const;

 private:
  class Index;
  std::unique_ptr<const Index> index_;
};

}  // namespace curvix
