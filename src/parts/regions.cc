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

}  // namespace curvix
