// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Points in space, found by where they are.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
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
  // The points are point(item) of the items, or a member of theirs.
  template <typename Items, typename Point>
  PointTree(const Items& items, const Point& point)
      : PointTree(PointsOf(items, point)) {}
  ~PointTree();

  // The nearest point; any one of them if several are equally near. There must
  // be a point.
  Neighbor Nearest(const Eigen::Vector3d& query) const;

  // The points at most `radius` from `center`, in ascending order of index.
  std::vector<std::size_t> Within(const Eigen::Vector3d& center,
                                  double radius) const;

 private:
  template <typename Items, typename Point>
  static std::vector<Eigen::Vector3d> PointsOf(const Items& items,
                                               const Point& point) {
    std::vector<Eigen::Vector3d> points;
    points.reserve(items.size());
    for (const auto& item : items) points.push_back(std::invoke(point, item));
    return points;
  }

  class Index;
  std::unique_ptr<const Index> index_;
};

}  // namespace curvix
