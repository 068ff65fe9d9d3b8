// SPDX-License-Identifier: BSD-3-Clause
#include "edge_detection/curvelets.h"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/grid_index.h"

namespace curvix {
namespace {

// Largest angle between the tangents of neighbours and their chord (Sec. 5).
// Where a contour bends more within a step, it has a corner.
constexpr double kMaxNeighborAngle = DegToRad(15);

// Offers edges to each other as neighbours, pair by pair.
class Linker {
 public:
  Linker(const std::vector<Edge2d>& edges, const EdgeDetectionOptions& options)
      : edges_(edges),
        max_distance_(options.max_neighbor_distance_px),
        min_cosine_(std::cos(kMaxNeighborAngle)),
        rounded_min_cosine_(static_cast<float>(min_cosine_ - 1e-5)),
        neighbors_(edges.size()),
        distances_(edges.size(), {max_distance_, max_distance_}) {}

  std::vector<EdgeNeighbors> Link() {
    GridIndex(edges_, max_distance_)
        .VisitPairs(
            [this](const IndexedEdge& edge,
                   const IndexedEdge* begin,
                   const IndexedEdge* end) { ConsiderAll(edge, begin, end); });
    return std::move(neighbors_);
  }

 private:
  struct Distances {
    double previous;
    double next;
  };

  // Considers those of [begin, end) that point the same way, which few do. They
  // are collected without branches.
  void ConsiderAll(const IndexedEdge& edge,
                   const IndexedEdge* begin,
                   const IndexedEdge* end) {
    const auto size = static_cast<std::size_t>(end - begin);
    if (parallel_.size() < size) parallel_.resize(size);
    const IndexedEdge** parallel = parallel_.data();
    for (const IndexedEdge* other = begin; other != end; ++other) {
      *parallel = other;
      parallel += edge.tangent.dot(other->tangent) >= rounded_min_cosine_;
    }
    for (const IndexedEdge** other = parallel_.data(); other != parallel;
         ++other) {
      Consider(edge, **other);
    }
  }

  void Consider(const IndexedEdge& a, const IndexedEdge& b) {
    const Eigen::Vector2d tangent_a = a.tangent.cast<double>();
    const Eigen::Vector2d tangent_b = b.tangent.cast<double>();
    if (tangent_a.dot(tangent_b) < min_cosine_) return;
    const Eigen::Vector2d chord = Position(b) - Position(a);
    const double distance = chord.norm();
    if (distance == 0 || distance > max_distance_) return;
    const double min_along = min_cosine_ * distance;
    const double along_a = chord.dot(tangent_a);
    const double along_b = chord.dot(tangent_b);
    if (along_a >= min_along && along_b >= min_along) Join(a, b, distance);
    if (-along_a >= min_along && -along_b >= min_along) Join(b, a, distance);
  }

  // Offers `b` as what follows on `a`.
  void Join(const IndexedEdge& a, const IndexedEdge& b, double distance) {
    const auto i = static_cast<std::size_t>(a.edge_idx);
    const auto j = static_cast<std::size_t>(b.edge_idx);
    Offer(b.edge_idx, distance, neighbors_[i].next, distances_[i].next);
    Offer(a.edge_idx, distance, neighbors_[j].previous, distances_[j].previous);
  }

  static void Offer(std::int32_t candidate_idx,
                    double candidate_distance,
                    std::optional<std::int32_t>& edge_idx,
                    double& distance) {
    const bool nearer = candidate_distance < distance;
    const bool tied = candidate_distance == distance;
    if (!nearer && !(tied && (!edge_idx || candidate_idx < *edge_idx))) return;
    edge_idx = candidate_idx;
    distance = candidate_distance;
  }

  Eigen::Vector2d Position(const IndexedEdge& edge) const {
    return edges_[static_cast<std::size_t>(edge.edge_idx)].position;
  }

  const std::vector<Edge2d>& edges_;
  double max_distance_;
  double min_cosine_;
  float rounded_min_cosine_;  // not above that of floats
  std::vector<EdgeNeighbors> neighbors_;
  std::vector<Distances> distances_;  // to the neighbours found so far
  std::vector<const IndexedEdge*> parallel_;
};

}  // namespace

std::vector<EdgeNeighbors> LinkNeighbors(const std::vector<Edge2d>& edges,
                                         const EdgeDetectionOptions& options) {
  return Linker(edges, options).Link();
}

}  // namespace curvix
