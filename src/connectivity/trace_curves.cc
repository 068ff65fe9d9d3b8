// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 6.
#include "connectivity/trace_curves.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/check.h"
#include "geometry/pixel_size.h"

namespace curvix {
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

std::vector<Curve> DropShortCurves(std::vector<Curve> curves,
                                   const std::vector<PosedView>& views,
                                   double min_length_px) {
  std::erase_if(curves, [&](const Curve& curve) {
    return curve.samples.size() < 2 ||
           LengthInPixels(curve, views) < min_length_px;
  });
  return curves;
}

}  // namespace curvix
