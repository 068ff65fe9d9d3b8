// SPDX-License-Identifier: BSD-3-Clause
#include "parts/scene_parts.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/count_text.h"
#include "base/median.h"
#include "edge_sketch/view_overlap.h"
#include "geometry/detected_edge.h"
#include "model/check_input.h"
#include "model/posed_view.h"
#include "parts/partition_views.h"

namespace curvix {
namespace {

constexpr double kOverlapPx = 25;

// The length that a typical view shows on one pixel, world units.
double TypicalPixel(const std::vector<PosedView>& views,
                    const std::vector<std::vector<Eigen::Vector3d>>& places) {
  std::vector<double> pixels;
  for (std::size_t i = 0; i < views.size(); ++i) {
    std::vector<double> depths;
    for (const Eigen::Vector3d& place : places[i]) {
      depths.push_back(std::max(0.0, views[i].InCamera(place).z()));
    }
    pixels.push_back(Median(std::move(depths)) / views[i].calibration(0, 0));
  }
  return Median(std::move(pixels));
}

// The curve with the edges that it names: those of its samples, in order.
TracedCurve TraceCurve(Curve curve, const std::vector<EdgeMap>& edge_maps) {
  TracedCurve traced{std::move(curve), {}};
  ForEachSupport(traced.curve, [&](EdgeRef& ref) {
    traced.edges.push_back(EdgeOf(ref, edge_maps));
    ref.edge_idx = static_cast<std::int32_t>(traced.edges.size() - 1);
  });
  return traced;
}

}  // namespace

Result<ScenePartition> PartitionScene(const Scene& scene,
                                      int max_views_per_part) {
  CURVIX_RETURN_IF_ERROR(CheckScene(scene));
  const std::vector<PosedView> views = MakePosedViews(scene);
  const auto places = FindPlaces(views, scene.points);
  std::optional<ScenePartition> partition = PartitionViews(
      places, kOverlapPx * TypicalPixel(views, places), max_views_per_part);
  if (partition) return *std::move(partition);
  return Status::InvalidArgument("the " + Plural(views.size(), "view") +
                                 " cannot be divided into parts of at most " +
                                 Plural(max_views_per_part, "view") +
                                 ", because each also needs the views that "
                                 "overlap it; allow more views per part");
}

PartResult TakePart(const ScenePartition& partition,
                    int part_idx,
                    const CurveSet& curves,
                    const std::vector<EdgeMap>& edge_maps) {
  const auto cores = CoresOf(partition);
  PartResult result;
  for (Curve& curve : CutCurves(curves.curves,
                                cores[static_cast<std::size_t>(part_idx)],
                                partition.overlap)) {
    result.curves.push_back(TraceCurve(std::move(curve), edge_maps));
  }
  const ScenePart& part = partition.parts[static_cast<std::size_t>(part_idx)];
  for (std::size_t i = 0; i < edge_maps.size(); ++i) {
    if (std::ranges::binary_search(part.own_view_idxs, part.view_idxs[i])) {
      result.num_own_edges_2d +=
          static_cast<std::int64_t>(edge_maps[i].edges.size());
    }
  }
  return result;
}

}  // namespace curvix
