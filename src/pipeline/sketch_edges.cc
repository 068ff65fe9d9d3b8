// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/sketch_edges.h"

#include <algorithm>

#include "edge_sketch/sketch_by_views.h"
#include "edge_sketch/view_index.h"
#include "edge_sketch/view_overlap.h"
#include "paper/sketch_by_pairs.h"

namespace curvix {

bool CurvesGrow(const std::vector<EdgeMap>& edge_maps, const Options& options) {
  return options.curve_growth.enabled && AreCrowded(edge_maps);
}

EdgeSketch SketchViews(const std::vector<PosedView>& views,
                       const std::vector<EdgeMap>& edge_maps,
                       const std::vector<ScenePoint>& points,
                       const Options& options,
                       const StepDone& step_done) {
  const DistinctViews distinct =
      FindDistinctViews(views, edge_maps, points, options);
  const auto depths =
      FindDepthRanges(views, points, options.hypotheses.depth_margin);
  std::vector<ViewIndex> indices;
  SketchInput input{views,
                    edge_maps,
                    indices,
                    distinct,
                    depths,
                    options,
                    options.hypotheses.EdgeSigmaPx()};
  switch (options.hypotheses.view_selection) {
    case ViewSelection::kUnusedEdges:
      return SketchByPairs(input, step_done);
    case ViewSelection::kEveryView: {
      indices =
          IndexViews(views, edge_maps, distinct, options.runtime.num_threads);
      AddPresence(options.validation, options.runtime.num_threads, indices);
      input.sigma_px = EstimateEdgeSigma(input, step_done);
      input.finds_seeds = CurvesGrow(edge_maps, options);
      EdgeSketch sketch = TrackByViews(input, step_done);
      indices.clear();  // frees memory that the next step can use
      DropExplained(views, edge_maps, options.validation, sketch);
      sketch.counts.repeated_views =
          std::ranges::count(distinct.are_repeated, true);
      return sketch;
    }
  }
  return {};
}

}  // namespace curvix
