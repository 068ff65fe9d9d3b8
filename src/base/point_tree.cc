// SPDX-License-Identifier: BSD-3-Clause
#include "base/point_tree.h"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <utility>

#include "base/check.h"

namespace curvix {
namespace {

// Collects points of at most a squared distance; nanoflann's own collectors of
// this kind changed their types between the versions that are in use.
class Collector {
 public:
  using DistanceType = double;
  using IndexType = std::size_t;

  explicit Collector(double max_squared)
      : max_squared_(max_squared),
        worst_(std::nextafter(max_squared, HUGE_VAL)) {}

  std::size_t size() const { return indices_.size(); }
  bool empty() const { return indices_.empty(); }
  bool full() const { return true; }
  bool addPoint(double squared, std::size_t index) {
    if (squared <= max_squared_) indices_.push_back(index);
    return true;
  }
  // Nodes at exactly this distance are not searched, hence the next number.
  double worstDist() const { return worst_; }
  void sort() { std::ranges::sort(indices_); }

  std::vector<std::size_t> Take() {
    sort();
    return std::move(indices_);
  }

 private:
  double max_squared_, worst_;
  std::vector<std::size_t> indices_;
};

}  // namespace

class PointTree::Index {
 public:
  explicit Index(std::vector<Eigen::Vector3d> points)
      : access_{std::move(points)}, tree_(3, access_) {
    tree_.buildIndex();
  }

  bool empty() const { return access_.points.empty(); }

  template <typename Results>
  void Search(const Eigen::Vector3d& query, Results& results) const {
    tree_.findNeighbors(results, query.data(), {});
  }

 private:
  // How nanoflann sees the points.
  struct PointAccess {
    std::vector<Eigen::Vector3d> points;

    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t index, std::size_t axis) const {
      return points[index][static_cast<Eigen::Index>(axis)];
    }
    template <typename Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };

  using Distance =
      nanoflann::L2_Simple_Adaptor<double, PointAccess, double, std::size_t>;
  using Tree = nanoflann::
      KDTreeSingleIndexAdaptor<Distance, PointAccess, 3, std::size_t>;

  PointAccess access_;
  Tree tree_;
};

PointTree::PointTree(std::vector<Eigen::Vector3d> points)
    : index_(std::make_unique<const Index>(std::move(points))) {}

PointTree::~PointTree() = default;

PointTree::Neighbor PointTree::Nearest(const Eigen::Vector3d& query) const {
  CURVIX_CHECK(!index_->empty(), "no point is the nearest of none");
  Neighbor nearest;
  double squared = 0;
  nanoflann::KNNResultSet<double, std::size_t> results(1);
  results.init(&nearest.index, &squared);
  index_->Search(query, results);
  nearest.distance = std::sqrt(squared);
  return nearest;
}

std::vector<std::size_t> PointTree::Within(const Eigen::Vector3d& center,
                                           double radius) const {
  Collector results(radius * radius);
  index_->Search(center, results);
  return results.Take();
}

}  // namespace curvix
