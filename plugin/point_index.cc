// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Nearest neighbours among points in space.
#include "plugin/point_index.h"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <stdexcept>
#include <utility>

namespace curvix {
namespace {

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

// Collects points of at most a squared distance; nanoflann's own collectors of
// this kind changed their types between the versions that are in use.
class Collector {
 public:
  using DistanceType = double;
  using IndexType = std::size_t;

  explicit Collector(double max_squared) : max_squared_(max_squared) {}

  std::size_t size() const { return indices_.size(); }
  bool empty() const { return indices_.empty(); }
  bool full() const { return true; }
  bool addPoint(double squared, std::size_t index) {
    if (squared <= max_squared_) indices_.push_back(index);
    return true;
  }
  // Nodes at exactly this distance are not searched, hence the next number.
  double worstDist() const { return std::nextafter(max_squared_, HUGE_VAL); }
  void sort() { std::sort(indices_.begin(), indices_.end()); }

  std::vector<std::size_t> Take() {
    sort();
    return std::move(indices_);
  }

 private:
  double max_squared_;
  std::vector<std::size_t> indices_;
};

}  // namespace

class PointIndex::Tree {
 public:
  explicit Tree(std::vector<Eigen::Vector3d> points)
      : access_{std::move(points)}, index_(3, access_) {
    index_.buildIndex();
  }

  template <typename Results>
  void Search(const Eigen::Vector3d& query, Results& results) const {
    index_.findNeighbors(results, query.data(), {});
  }

 private:
  using Distance =
      nanoflann::L2_Simple_Adaptor<double, PointAccess, double, std::size_t>;
  using Index = nanoflann::
      KDTreeSingleIndexAdaptor<Distance, PointAccess, 3, std::size_t>;

  PointAccess access_;
  Index index_;
};

PointIndex::PointIndex(std::vector<Eigen::Vector3d> points) {
  if (points.empty()) throw std::logic_error("PointIndex without points");
  tree_ = std::make_unique<const Tree>(std::move(points));
}

PointIndex::~PointIndex() = default;

PointIndex::Neighbor PointIndex::Nearest(const Eigen::Vector3d& query) const {
  Neighbor nearest;
  double squared = 0;
  nanoflann::KNNResultSet<double, std::size_t> results(1);
  results.init(&nearest.index, &squared);
  tree_->Search(query, results);
  nearest.distance = std::sqrt(squared);
  return nearest;
}

std::vector<std::size_t> PointIndex::Within(const Eigen::Vector3d& query,
                                            double radius) const {
  Collector results(radius * radius);
  tree_->Search(query, results);
  return results.Take();
}

}  // namespace curvix
