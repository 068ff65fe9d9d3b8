// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/sketch_edges.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "edge_sketch/depth_range.h"
#include "edge_sketch/edge_noise.h"
#include "edge_sketch/sketch_by_views.h"
#include "edge_sketch/sketch_input.h"
#include "edge_sketch/view_indices.h"
#include "edge_sketch/view_overlap.h"
#include "paper/sketch_by_pairs.h"

namespace curvix {
namespace {

// Views that overlap another.
std::int64_t NumOverlapping(const Overlaps& overlaps) {
  return std::count_if(overlaps.begin(),
                       overlaps.end(),
                       [](const auto& others) { return !others.empty(); });
}

}  // namespace

bool CurvesGrow(const std::vector<EdgeMap>& edge_maps, const Options& options) {
  return options.curve_growth.enabled && AreCrowded(edge_maps);
}

EdgeSketch SketchEdges(const std::vector<PosedView>& views,
                       const std::vector<EdgeMap>& edge_maps,
                       const std::vector<ScenePoint>& points,
                       const Options& options,
                       const StepDone& step_done) {
  Overlaps overlaps = FindOverlaps(views, points);
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
    case ViewSelection::kEveryView: {
      const std::int64_t num_overlapping = NumOverlapping(overlaps);
      overlaps =
          OfDistinctViews(std::move(overlaps), points, options.validation);
      indices = IndexViews(views, edge_maps, options.runtime.num_threads);
      AddPresence(options.validation, options.runtime.num_threads, indices);
      input.sigma_px = EstimateEdgeSigma(input, step_done);
      input.finds_seeds = CurvesGrow(edge_maps, options);
      EdgeSketch sketch = SketchByViews(input, step_done);
      sketch.counts.repeated_views = num_overlapping - NumOverlapping(overlaps);
      return sketch;
    }
  }
  return {};
}

}  // namespace curvix
