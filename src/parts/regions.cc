// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "parts/regions.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

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

std::vector<Run> RunsOf(const std::vector<bool>& kept) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) continue;
    if (i == 0 || !kept[i - 1]) runs.push_back({i, i});
    runs.back().end = i + 1;
  }
  return runs;
}

void OpenAtGap(Curve& curve, std::vector<bool>& kept) {
  const auto gap = std::find(kept.begin(), kept.end(), false);
  if (!curve.closed || gap == kept.end()) return;
  const auto offset = gap - kept.begin();
  std::rotate(curve.samples.begin(),
              curve.samples.begin() + offset,
              curve.samples.end());
  std::rotate(kept.begin(), gap, kept.end());
  curve.closed = false;
}

Curve TakeOut(Curve& curve, const Run& run) {
  if (run.begin == 0 && run.end == curve.samples.size()) {
    return std::move(curve);
  }
  const auto begin = std::make_move_iterator(curve.samples.begin());
  Curve part;
  part.is_occluding_contour = curve.is_occluding_contour;
  part.samples.assign(begin + static_cast<std::ptrdiff_t>(run.begin),
                      begin + static_cast<std::ptrdiff_t>(run.end));
  return part;
}

}  // namespace curvix
