// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/connect_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/check.h"
#include "base/parallel.h"
#include "geometry/image_edge.h"
#include "geometry/pixel_size.h"
#include "model/curve_chains.h"

namespace curvix {
namespace {

// The best candidate at the front ([0]) and back ([1]) of an edge: the end of
// another edge.
using Choice = std::array<std::optional<EndIdx>, 2>;

// 0: `to` lies in front of `from`; 1: behind it; nullopt: beside it.
std::optional<std::size_t> SideOf(const Edge3d& from, const Edge3d& to) {
  const double along = (to.position - from.position).dot(from.tangent);
  if (along == 0) return std::nullopt;
  return along > 0 ? 0 : 1;
}

bool AreWithinReach(const EdgeDistances& between,
                    double unit,
                    const ConnectivityOptions& options) {
  return between.tangential <= options.max_step_px * unit &&
         between.normal <= options.max_normal_distance_px * unit &&
         between.normal <= between.tangential &&
         between.angle <= DegToRad(options.max_angle_deg);
}

Choice ChooseNeighbors(const std::vector<Edge3d>& edges,
                       std::span<const NeighborLink> links,
                       const std::vector<double>& pixel_sizes,
                       const ConnectivityOptions& options,
                       std::size_t i) {
  Choice choice;
  std::array<double, 2> best = {0, 0};
  for (const NeighborLink& link : links) {
    const auto j = static_cast<std::size_t>(link.edge_idx);
    const auto side = SideOf(edges[i], edges[j]);
    const auto other_side = SideOf(edges[j], edges[i]);
    if (!side.has_value() || !other_side.has_value()) continue;
    const EdgeDistances between = MeasureDistances(edges[i], edges[j]);
    const double unit = std::min(pixel_sizes[i], pixel_sizes[j]);
    if (!AreWithinReach(between, unit, options)) continue;
    const double cost = between.tangential + between.normal;
    if (!choice[*side].has_value() || cost < best[*side]) {
      choice[*side] = 2 * j + *other_side;
      best[*side] = cost;
    }
  }
  return choice;
}

EndTies MutualTies(const std::vector<Choice>& choices) {
  EndTies ties(2 * choices.size());
  for (EndIdx end = 0; end < ties.size(); ++end) {
    const auto wanted = choices[ItemOf(end)][end % 2];
    if (wanted.has_value() && choices[ItemOf(*wanted)][*wanted % 2] == end) {
      ties[end] = wanted;
    }
  }
  return ties;
}

ConnectivityGraph GraphOf(const EndTies& ties) {
  const std::size_t num_edges = ties.size() / 2;
  ConnectivityGraph graph = {
      std::vector<std::optional<std::int32_t>>(num_edges),
      std::vector<std::optional<std::int32_t>>(num_edges),
      std::vector<bool>(num_edges, false)};
  for (const EndChain& chain : FollowEnds(ties)) {
    const std::size_t size = chain.items.size();
    for (std::size_t k = 0; k < size; ++k) {
      const ChainItem& here = chain.items[k];
      graph.flipped[here.item] = here.flipped;
      if (k + 1 == size && !chain.closed) continue;
      const ChainItem& next = chain.items[(k + 1) % size];
      graph.forward[here.item] = static_cast<std::int32_t>(next.item);
      graph.backward[next.item] = static_cast<std::int32_t>(here.item);
    }
  }
  return graph;
}

}  // namespace

ConnectivityGraph ConnectEdges(const std::vector<Edge3d>& edges,
                               const NeighborhoodGraph& graph,
                               const std::vector<PosedView>& views,
                               const ConnectivityOptions& options,
                               int num_threads) {
  CURVIX_CHECK(
      graph.NumEdges() == edges.size(),
      "a graph of " << graph.NumEdges() << " edges for " << edges.size());
  const std::vector<double> pixel_sizes = PixelSizes(edges, views);
  std::vector<Choice> choices(edges.size());
  ParallelFor(edges.size(), num_threads, [&](std::size_t i) {
    choices[i] =
        ChooseNeighbors(edges, graph.Neighbors(i), pixel_sizes, options, i);
  });
  return GraphOf(MutualTies(choices));
}

namespace {

using Neighbors = std::vector<std::optional<std::int32_t>>;

// The edges after `start`, up to the last or to the one before `start`.
std::vector<std::size_t> Walk(const Neighbors& next, std::size_t start) {
  std::vector<std::size_t> walk;
  for (auto here = next[start]; here.has_value();) {
    const auto edge_idx = static_cast<std::size_t>(*here);
    if (edge_idx == start) break;
    walk.push_back(edge_idx);
    here = next[edge_idx];
  }
  return walk;
}

CurveSample SampleOf(const Edge3d& edge, bool flipped) {
  CurveSample sample;
  sample.position = edge.position;
  sample.tangent = flipped ? Eigen::Vector3d(-edge.tangent) : edge.tangent;
  sample.sigma = edge.sigma;
  sample.evidence = edge.evidence;
  sample.support = edge.support;
  return sample;
}

}  // namespace

std::vector<Curve> TraceCurves(const std::vector<Edge3d>& edges,
                               const ConnectivityGraph& graph) {
  Validate(graph);
  CURVIX_CHECK(graph.NumEdges() == edges.size(),
               graph.NumEdges() << " nodes for " << edges.size() << " edges");
  std::vector<bool> is_traced(edges.size(), false);
  std::vector<Curve> curves;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (is_traced[start]) continue;
    const std::vector<std::size_t> ahead = Walk(graph.forward, start);
    const std::size_t last = ahead.empty() ? start : ahead.back();
    Curve curve;
    curve.closed = graph.forward[last] == static_cast<std::int32_t>(start);
    std::vector<std::size_t> walk;
    if (!curve.closed) walk = Walk(graph.backward, start);
    std::reverse(walk.begin(), walk.end());
    walk.push_back(start);
    walk.insert(walk.end(), ahead.begin(), ahead.end());
    for (const std::size_t edge_idx : walk) {
      is_traced[edge_idx] = true;
      curve.samples.push_back(
          SampleOf(edges[edge_idx], graph.flipped[edge_idx]));
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace curvix
