// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/group_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/angles.h"
#include "base/check.h"
#include "base/parallel.h"
#include "curve_drawing/link_edges.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

// The first edge is front().
using Group = std::vector<std::size_t>;
using Rows = std::vector<std::vector<std::int32_t>>;

std::size_t NumVotes(const Edge3d& edge) {
  return std::max<std::size_t>(edge.support.size(), 1);
}

// Inverse variance where it is known, else votes; all edges come from one
// sketch, so it is known for all or for none.
double Weight(const Edge3d& edge) {
  return edge.sigma > 0 ? 1 / (edge.sigma * edge.sigma)
                        : static_cast<double>(NumVotes(edge));
}

// For each edge, the linked edges that may join its group, ascending.
Rows FindCompanions(const std::vector<Edge3d>& edges,
                    const NeighborhoodGraph& graph,
                    const std::vector<double>& pixel_sizes,
                    const ConnectivityOptions& options,
                    int num_threads) {
  Rows companions(edges.size());
  ParallelFor(edges.size(), num_threads, [&](std::size_t i) {
    for (const NeighborLink& link : graph.Neighbors(i)) {
      const auto j = static_cast<std::size_t>(link.edge_idx);
      const double unit = std::min(pixel_sizes[i], pixel_sizes[j]);
      const EdgeDistances between = MeasureDistances(edges[i], edges[j]);
      if (between.tangential <= options.sample_spacing_px * unit &&
          between.normal <= kMaxNormalDistancePx * unit &&
          between.angle <= DegToRad(options.max_angle_deg)) {
        companions[i].push_back(link.edge_idx);
      }
    }
  });
  return companions;
}

// All edges, the best supported first.
std::vector<std::size_t> ByCrowd(const std::vector<Edge3d>& edges,
                                 const Rows& companions) {
  std::vector<std::size_t> crowd(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    crowd[i] = NumVotes(edges[i]);
    for (const std::int32_t j : companions[i]) {
      crowd[i] += NumVotes(edges[static_cast<std::size_t>(j)]);
    }
  }
  std::vector<std::size_t> order(edges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, std::greater<>(), [&](std::size_t i) { return crowd[i]; });
  return order;
}

std::vector<Group> FormGroups(const std::vector<std::size_t>& order,
                              const Rows& companions) {
  std::vector<bool> is_taken(order.size(), false);
  std::vector<Group> groups;
  for (const std::size_t first : order) {
    if (is_taken[first]) continue;
    Group group = {first};
    for (const std::int32_t companion : companions[first]) {
      const auto j = static_cast<std::size_t>(companion);
      if (!is_taken[j]) group.push_back(j);
    }
    for (const std::size_t member : group) is_taken[member] = true;
    groups.push_back(std::move(group));
  }
  std::ranges::sort(groups);
  return groups;
}

// Adds to `support` one 2D edge of each view that it does not have yet.
void AddViews(const std::vector<EdgeRef>& more, std::vector<EdgeRef>& support) {
  const auto num_before = static_cast<std::ptrdiff_t>(support.size());
  const auto by_view = [](const EdgeRef& a, const EdgeRef& b) {
    return a.view_idx < b.view_idx;
  };
  for (const EdgeRef& ref : more) {
    if (!std::binary_search(
            support.begin(), support.begin() + num_before, ref, by_view)) {
      support.push_back(ref);
    }
  }
  std::inplace_merge(
      support.begin(), support.begin() + num_before, support.end());
}

Edge3d Fuse(const std::vector<Edge3d>& edges, const Group& group) {
  Edge3d fused = edges[group.front()];
  const Eigen::Vector3d tangent = fused.tangent;
  Eigen::Vector3d sum_offsets = Eigen::Vector3d::Zero();
  Eigen::Vector3d sum_tangents = Eigen::Vector3d::Zero();
  double sum_weights = 0;
  for (const std::size_t member : group) {
    const Edge3d& edge = edges[member];
    const double weight = Weight(edge);
    const double sign = edge.tangent.dot(tangent) < 0 ? -1 : 1;
    sum_offsets += weight * (edge.position - fused.position);
    sum_tangents += weight * sign * edge.tangent;
    sum_weights += weight;
    if (edge.sigma < fused.sigma) fused.sigma = edge.sigma;
    fused.evidence = std::max(fused.evidence, edge.evidence);
    AddViews(edge.support, fused.support);
  }
  const Eigen::Vector3d offset = sum_offsets / sum_weights;
  fused.position += offset - offset.dot(tangent) * tangent;
  fused.tangent = sum_tangents.normalized();
  return fused;
}

}  // namespace

ThinnedEdges ThinEdges(const std::vector<Edge3d>& edges,
                       const NeighborhoodGraph& graph,
                       const std::vector<PosedView>& views,
                       const ConnectivityOptions& options,
                       int num_threads) {
  if (!(options.sample_spacing_px > 0)) return {edges, graph};
  const Rows companions = FindCompanions(
      edges, graph, PixelSizes(edges, views), options, num_threads);
  const std::vector<Group> groups =
      FormGroups(ByCrowd(edges, companions), companions);
  std::vector<Edge3d> thinned(groups.size());
  std::vector<std::int32_t> group_of(edges.size());
  ParallelFor(groups.size(), num_threads, [&](std::size_t g) {
    thinned[g] = Fuse(edges, groups[g]);
    for (const std::size_t member : groups[g]) {
      group_of[member] = static_cast<std::int32_t>(g);
    }
  });
  return {std::move(thinned),
          Contract(graph, group_of, groups.size(), num_threads)};
}

namespace {

// Longest step along the tangents to the next edge (Sec. 6), pixels: several
// spacings of edges, since some are missing.
constexpr double kMaxStepPx = 4;

// The best candidate at the head ([0]) and tail ([1]) of an edge: the end of
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
  return between.tangential <= kMaxStepPx * unit &&
         between.normal <= kMaxNormalDistancePx * unit &&
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

}  // namespace

EndTies ConnectEdges(const std::vector<Edge3d>& edges,
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
  return MutualTies(choices);
}

namespace {

CurveSample SampleOf(const Edge3d& edge, bool flipped) {
  CurveSample sample;
  sample.position = edge.position;
  sample.tangent = flipped ? Eigen::Vector3d(-edge.tangent) : edge.tangent;
  sample.sigma = edge.sigma;
  sample.evidence = edge.evidence;
  sample.support = edge.support;
  return sample;
}

// The chains of FollowEnds as curves, in the same order: samples in walking
// order, tangents along the curve, support carried over. A chain that returns
// to its start is a closed curve. Every edge is in exactly one curve, once; an
// edge without neighbours is a curve of one sample, for JoinCurves to take up
// or GroupEdges to drop.
std::vector<Curve> TraceCurves(const std::vector<Edge3d>& edges,
                               const EndTies& ties) {
  CURVIX_CHECK(ties.size() == 2 * edges.size(),
               ties.size() << " ends of " << edges.size() << " edges");
  std::vector<Curve> curves;
  for (const EndChain& chain : FollowEnds(ties)) {
    Curve& curve = curves.emplace_back();
    curve.closed = chain.closed;
    for (const ChainItem& item : chain.items) {
      curve.samples.push_back(SampleOf(edges[item.item], item.flipped));
    }
  }
  return curves;
}

}  // namespace

std::vector<Curve> GroupEdges(const std::vector<Edge3d>& edges,
                              const NeighborhoodGraph& graph,
                              const std::vector<PosedView>& views,
                              const ConnectivityOptions& options,
                              int num_threads,
                              const StepDone& step_done) {
  constexpr int kNumSteps = 5;
  const auto stops_after = [&](int step) {
    return step_done && !step_done(step, kNumSteps);
  };
  const ThinnedEdges thinned =
      ThinEdges(edges, graph, views, options, num_threads);
  if (stops_after(1)) return {};
  const EndTies ties =
      ConnectEdges(thinned.edges, thinned.graph, views, options, num_threads);
  std::vector<Curve> curves = TraceCurves(thinned.edges, ties);
  if (stops_after(2)) return {};
  curves = DropDuplicates(std::move(curves), views, options);
  if (stops_after(3)) return {};
  curves = JoinCurves(std::move(curves), views, options);
  if (stops_after(4)) return {};
  curves = SplitCorners(curves, views, options);
  std::erase_if(curves, [&](const Curve& curve) {
    return IsShort(curve, views, options.min_length_px);
  });
  return curves;
}

}  // namespace curvix
