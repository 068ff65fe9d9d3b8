// SPDX-License-Identifier: BSD-3-Clause
#include "paper/align_edges.h"

#include <algorithm>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"

namespace curvix {
namespace {

// Of the mean length of links: forces below this are rest.
constexpr double kRestForce = 1e-3;

std::vector<SpaceEdge> PointsOf(const std::vector<Edge3d>& edges) {
  std::vector<SpaceEdge> points;
  points.reserve(edges.size());
  for (const Edge3d& edge : edges) {
    points.push_back({edge.position, edge.tangent});
  }
  return points;
}

// World units; zero without links.
double MeanLinkLength(const std::vector<SpaceEdge>& points,
                      const NeighborhoodGraph& graph) {
  double sum = 0;
  for (std::size_t i = 0; i < graph.NumEdges(); ++i) {
    for (const NeighborLink& link : graph.Neighbors(i)) {
      const auto j = static_cast<std::size_t>(link.edge_idx);
      if (j > i) sum += (points[j].position - points[i].position).norm();
    }
  }
  const std::size_t num_links = std::max<std::size_t>(graph.NumLinks(), 1);
  return sum / static_cast<double>(num_links);
}

// One simultaneous step from `now` to `next`; returns the largest force.
double Step(const std::vector<SpaceEdge>& now,
            const NeighborhoodGraph& graph,
            const ForceModel& model,
            const AlignmentOptions& options,
            int num_threads,
            std::vector<SpaceEdge>& next) {
  std::vector<double> forces(now.size());
  ParallelFor(now.size(), num_threads, [&](std::size_t i) {
    const Pull pull = PullOn(i, graph.Neighbors(i), now, model);
    next[i].position = now[i].position + options.step_size * pull.force;
    next[i].tangent =
        (now[i].tangent + options.step_size * pull.torque).normalized();
    forces[i] = pull.force.norm();
  });
  return *std::ranges::max_element(forces);
}

}  // namespace

std::vector<Edge3d> AlignEdges(const std::vector<Edge3d>& edges,
                               const NeighborhoodGraph& graph,
                               const AlignmentOptions& options,
                               int num_threads) {
  CURVIX_CHECK(
      graph.NumEdges() == edges.size(),
      "a graph of " << graph.NumEdges() << " edges for " << edges.size());
  std::vector<SpaceEdge> points = PointsOf(edges);
  const double mean_length = MeanLinkLength(points, graph);
  if (!(mean_length > 0)) return edges;  // no links, or all in one place
  const ForceModel model = {mean_length, options.use_mean_direction};
  std::vector<SpaceEdge> next = points;
  for (int k = 0; k < options.num_iterations; ++k) {
    const double largest =
        Step(points, graph, model, options, num_threads, next);
    std::swap(points, next);
    if (largest < kRestForce * mean_length) break;
  }
  std::vector<Edge3d> aligned = edges;
  for (std::size_t i = 0; i < aligned.size(); ++i) {
    aligned[i].position = points[i].position;
    aligned[i].tangent = points[i].tangent;
  }
  return aligned;
}

Pull PullOn(std::size_t edge_idx,
            std::span<const NeighborLink> neighbors,
            const std::vector<SpaceEdge>& points,
            const ForceModel& model) {
  const SpaceEdge& point = points[edge_idx];
  Pull sum;
  double sum_weights = 0;
  for (const NeighborLink& link : neighbors) {
    const SpaceEdge& other = points[static_cast<std::size_t>(link.edge_idx)];
    const Eigen::Vector3d offset = other.position - point.position;
    const Eigen::Vector3d direction = point.tangent.dot(other.tangent) < 0
                                          ? Eigen::Vector3d(-other.tangent)
                                          : other.tangent;
    const double weight = link.Weight() / (offset.norm() + model.half_distance);
    // u is not normalised; u.u is at least 1, as the two unit vectors are at
    // most a right angle apart.
    const Eigen::Vector3d u = model.use_mean_direction
                                  ? Eigen::Vector3d(direction + point.tangent)
                                  : direction;
    sum.force += weight * (offset - (offset.dot(u) / u.squaredNorm()) * u);
    sum.torque += weight * direction;
    sum_weights += weight;
  }
  if (!(sum_weights > 0)) return {};
  const Eigen::Vector3d mean_direction = sum.torque / sum_weights;
  return {sum.force / sum_weights,
          mean_direction - mean_direction.dot(point.tangent) * point.tangent};
}

}  // namespace curvix
