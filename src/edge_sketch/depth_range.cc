// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/depth_range.h"

#include <algorithm>
#include <cstddef>

namespace curvix {
namespace {

constexpr std::size_t kMinNumPointsForRange = 16;
constexpr std::size_t kMaxNumWrong = 2;  // on either side
constexpr double kMinRange = 0.2;        // of the median

DepthRange RangeAround(std::vector<double> inverse_depths, double margin) {
  if (inverse_depths.size() < kMinNumPointsForRange) return {};
  std::ranges::sort(inverse_depths);
  const double least = inverse_depths[kMaxNumWrong];
  const double most = inverse_depths[inverse_depths.size() - 1 - kMaxNumWrong];
  const double median = inverse_depths[inverse_depths.size() / 2];
  const double beyond = margin * std::max(most - least, kMinRange * median);
  // 1 / 0 is infinity.
  return {1 / (most + beyond), 1 / std::max(0.0, least - beyond)};
}

}  // namespace

std::vector<DepthRange> FindDepthRanges(const std::vector<PosedView>& views,
                                        const std::vector<ScenePoint>& points,
                                        double margin) {
  std::vector<DepthRange> ranges(views.size());
  if (margin == 0) return ranges;
  std::vector<std::vector<double>> inverse_depths(views.size());
  for (const ScenePoint& point : points) {
    for (const int view_idx : point.view_idxs) {
      const auto i = static_cast<std::size_t>(view_idx);
      const double depth = views[i].InCamera(point.position).z();
      if (depth > 0) inverse_depths[i].push_back(1 / depth);
    }
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    ranges[i] = RangeAround(std::move(inverse_depths[i]), margin);
  }
  return ranges;
}

}  // namespace curvix
