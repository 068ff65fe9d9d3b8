// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/group_edges.h"

#include <utility>

#include "geometry/pixel_size.h"

namespace curvix {

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
