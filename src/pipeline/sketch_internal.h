// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 and 4. The two ways to a 3D edge sketch; see sketch_edges.h.
#pragma once

#include <vector>

#include "hypotheses/depth_range.h"
#include "hypotheses/view_overlap.h"
#include "pipeline/sketch_edges.h"
#include "validation/view_index.h"

namespace curvix {

struct SketchInput {
  const std::vector<PosedView>& views;
  const std::vector<EdgeMap>& edge_maps;
  // Of each view, with AddPresence(); for SketchByViews.
  const std::vector<ViewIndex>& indices;
  const std::vector<std::vector<ViewOverlap>>& overlaps;
  const std::vector<DepthRange>& depths;  // of each view
  const Options& options;
  // Standard deviation of a 2D edge's place. Pixels, > 0.
  double sigma_px = 0;
  // One edge in so many of each view asks for hypotheses, with SketchByViews.
  std::size_t h1_step = 1;
  // Curves will grow from the 3D edges: a few along each contour do, and none
  // on contours that are too weak for a curve. With SketchByViews.
  bool finds_seeds = false;
};

// Paper: pairs of views with most unused edges, wedge support.
EdgeSketch SketchByPairs(const SketchInput& input, const StepDone& step_done);

// Deviation: every view with its partners, tracked support.
EdgeSketch SketchByViews(const SketchInput& input, const StepDone& step_done);

// Which 2D edges have been used so far.
class UsedEdges {
 public:
  explicit UsedEdges(const std::vector<EdgeMap>& edge_maps);
  void Mark(const EdgeRef& ref);
  bool Contains(const EdgeRef& ref) const {
    return used_[static_cast<std::size_t>(ref.view_idx)]
                [static_cast<std::size_t>(ref.edge_idx)];
  }
  // Unused edges of each view.
  const std::vector<int>& num_unused() const { return num_unused_; }
  std::int64_t total() const;

 private:
  std::vector<std::vector<bool>> used_;
  std::vector<int> num_unused_;
};

}  // namespace curvix
