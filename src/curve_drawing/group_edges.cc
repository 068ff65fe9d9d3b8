// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/group_edges.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/check.h"
#include "base/parallel.h"
#include "curve_drawing/link_edges.h"
#include "geometry/pixel_size.h"

namespace curvix {
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

}  // namespace

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
