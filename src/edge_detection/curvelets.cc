// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5 (ii). Neighbours along image contours.
#include "edge_detection/curvelets.h"

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/angles.h"
#include "base/grid_index.h"

namespace curvix {
namespace {

struct Nearest {
  std::optional<std::int32_t> edge_idx;
  double distance;

  void Offer(std::int32_t candidate_idx, double candidate_distance) {
    const bool nearer = candidate_distance < distance;
    const bool tied = candidate_distance == distance;
    if (!nearer && !(tied && (!edge_idx || candidate_idx < *edge_idx))) return;
    edge_idx = candidate_idx;
    distance = candidate_distance;
  }
};

Eigen::Vector2d Tangent(const Edge2d& edge) {
  return {std::cos(edge.angle), std::sin(edge.angle)};
}

EdgeNeighbors NeighborsOf(const std::vector<Edge2d>& edges,
                          const GridIndex& index,
                          double max_distance,
                          double min_cosine,
                          std::size_t i) {
  const Eigen::Vector2d tangent = Tangent(edges[i]);
  Nearest previous{std::nullopt, max_distance};
  Nearest next{std::nullopt, max_distance};
  const auto consider = [&](const IndexedEdge& candidate) {
    const Eigen::Vector2d other_tangent = candidate.tangent.cast<double>();
    const auto j = static_cast<std::size_t>(candidate.edge_idx);
    if (j == i || tangent.dot(other_tangent) < min_cosine) return;
    const Eigen::Vector2d chord = edges[j].position - edges[i].position;
    const double along = chord.dot(tangent);
    const double along_other = chord.dot(other_tangent);
    const double distance = chord.norm();
    const double min_along = min_cosine * distance;
    if (along > 0 && along >= min_along && along_other >= min_along) {
      next.Offer(candidate.edge_idx, distance);
    }
    if (along < 0 && -along >= min_along && -along_other >= min_along) {
      previous.Offer(candidate.edge_idx, distance);
    }
  };
  index.VisitAround(edges[i].position, max_distance, consider);
  return {previous.edge_idx, next.edge_idx};
}

}  // namespace

std::vector<EdgeNeighbors> LinkNeighbors(const std::vector<Edge2d>& edges,
                                         const EdgeDetectionOptions& options) {
  const double max_distance = options.max_neighbor_distance_px;
  const double min_cosine = std::cos(DegToRad(options.max_neighbor_angle_deg));
  const GridIndex index(edges, max_distance);
  std::vector<EdgeNeighbors> neighbors;
  neighbors.reserve(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    neighbors.push_back(NeighborsOf(edges, index, max_distance, min_cosine, i));
  }
  return neighbors;
}

}  // namespace curvix
