// SPDX-License-Identifier: BSD-3-Clause
#include "parts/regions.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

#include "model/sample_ranges.h"

namespace curvix {
namespace {

bool IsBelow(const SceneCut& cut, const Eigen::Vector3d& position) {
  return cut.normal.dot(position) < cut.offset;
}

void Visit(const ScenePartition& partition,
           int node,
           const std::vector<Border>& borders,
           std::vector<std::vector<Border>>& cores) {
  if (node < 0) {
    cores[static_cast<std::size_t>(-1 - node)] = borders;
    return;
  }
  const SceneCut& cut = partition.cuts[static_cast<std::size_t>(node)];
  for (const bool is_above : {false, true}) {
    std::vector<Border> more = borders;
    more.push_back({cut.normal, cut.offset, is_above});
    Visit(partition, is_above ? cut.above : cut.below, more, cores);
  }
}

}  // namespace

int OwnerOf(const ScenePartition& partition, const Eigen::Vector3d& position) {
  int node = partition.cuts.empty() ? -1 : 0;
  while (node >= 0) {
    const SceneCut& cut = partition.cuts[static_cast<std::size_t>(node)];
    node = IsBelow(cut, position) ? cut.below : cut.above;
  }
  return -1 - node;
}

std::vector<std::vector<Border>> CoresOf(const ScenePartition& partition) {
  std::vector<std::vector<Border>> cores(partition.parts.size());
  if (!partition.cuts.empty()) Visit(partition, 0, {}, cores);
  return cores;
}

double DistanceBeyond(const std::vector<Border>& core,
                      const Eigen::Vector3d& position) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Border& border : core) {
    const double above = border.normal.dot(position) - border.offset;
    farthest = std::max(farthest, border.is_above ? -above : above);
  }
  return farthest;
}

std::vector<Curve> CutCurves(const std::vector<Curve>& curves,
                             const std::vector<Border>& core,
                             double overlap) {
  std::vector<Curve> pieces;
  for (Curve curve : curves) {
    const auto is_near = [&](const CurveSample& sample) {
      return DistanceBeyond(core, sample.position) <= overlap;
    };
    std::vector<bool> kept(curve.samples.size());
    std::transform(
        curve.samples.begin(), curve.samples.end(), kept.begin(), is_near);
    for (Curve& piece : KeepRanges(std::move(curve), std::move(kept))) {
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

TracedCurve TraceCurve(Curve curve, const std::vector<EdgeMap>& edge_maps) {
  TracedCurve traced{std::move(curve), {}};
  ForEachSupport(traced.curve, [&](EdgeRef& ref) {
    const EdgeMap& map = edge_maps[static_cast<std::size_t>(ref.view_idx)];
    traced.edges.push_back(map.edges[static_cast<std::size_t>(ref.edge_idx)]);
    ref.edge_idx = static_cast<std::int32_t>(traced.edges.size() - 1);
  });
  return traced;
}

}  // namespace curvix
