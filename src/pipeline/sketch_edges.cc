// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 and 4.
#include "pipeline/sketch_edges.h"

#include <algorithm>

#include "pipeline/edge_noise.h"
#include "pipeline/sketch_internal.h"
#include "pipeline/view_indices.h"

namespace curvix {

UsedEdges::UsedEdges(const std::vector<EdgeMap>& edge_maps) {
  for (const EdgeMap& map : edge_maps) {
    used_.emplace_back(map.edges.size(), false);
    num_unused_.push_back(static_cast<int>(map.edges.size()));
  }
}

void UsedEdges::Mark(const EdgeRef& ref) {
  const auto view_idx = static_cast<std::size_t>(ref.view_idx);
  const auto edge_idx = static_cast<std::size_t>(ref.edge_idx);
  if (used_[view_idx][edge_idx]) return;
  used_[view_idx][edge_idx] = true;
  --num_unused_[view_idx];
}

std::int64_t UsedEdges::total() const {
  std::int64_t total = 0;
  for (std::size_t i = 0; i < used_.size(); ++i) {
    total += static_cast<std::int64_t>(used_[i].size()) - num_unused_[i];
  }
  return total;
}

bool CurvesGrow(const std::vector<EdgeMap>& edge_maps, const Options& options) {
  return options.curve_growth.enabled && AreCrowded(edge_maps);
}

EdgeSketch SketchEdges(const std::vector<PosedView>& views,
                       const std::vector<EdgeMap>& edge_maps,
                       const std::vector<ScenePoint>& points,
                       const Options& options,
                       const StepDone& step_done) {
  const auto overlaps = FindOverlaps(views, points);
  const auto depths =
      FindDepthRanges(views, points, options.hypotheses.depth_margin);
  std::vector<ViewIndex> indices;
  SketchInput input{views,
                    edge_maps,
                    indices,
                    overlaps,
                    depths,
                    options,
                    options.hypotheses.EdgeSigmaPx()};
  switch (options.hypotheses.view_selection) {
    case ViewSelection::kUnusedEdges:
      return SketchByPairs(input, step_done);
    case ViewSelection::kEveryView:
      indices = IndexViews(views, edge_maps, options.runtime.num_threads);
      AddPresence(options.validation, options.runtime.num_threads, indices);
      input.sigma_px = EstimateEdgeSigma(input, step_done);
      input.finds_seeds = CurvesGrow(edge_maps, options);
      return SketchByViews(input, step_done);
  }
  return {};
}

}  // namespace curvix
