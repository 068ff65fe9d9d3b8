// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 and 4. The input of both ways to a 3D edge sketch, and which
// 2D edges are asked and used.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/cancelled.h"
#include "edge_sketch/view_index.h"
#include "edge_sketch/view_overlap.h"
#include "model/posed_view.h"

namespace curvix {

struct SketchInput {
  const std::vector<PosedView>& views;
  const std::vector<EdgeMap>& edge_maps;
  // Of each view, with AddPresence(); for SketchByViews.
  const std::vector<ViewIndex>& indices;
  const DistinctViews& distinct;
  const std::vector<DepthRange>& depths;  // of each view
  const Options& options;
  // Standard deviation of a 2D edge across its tangent. Pixels, > 0.
  double sigma_px = 0;
  // SketchByViews: hypotheses are made for one in h1_step edges of each view.
  std::size_t h1_step = 1;
  // SketchByViews: the 3D edges are seeds of growing curves, so that a few on
  // each contour are enough, none on contours too weak for a curve, and none of
  // pairs of 2D edges that look unlike.
  bool finds_seeds = false;
};

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

// Marks these edges and so many to either side of each along its contour.
void MarkAlongContours(const std::vector<EdgeRef>& refs,
                       const std::vector<EdgeMap>& edge_maps,
                       int num_links,
                       UsedEdges& used);

// For each edge whether it may become a seed: it is not texture
// (CurveGrowthOptions::IsTexture), and its contour is strong enough for a
// curve, since the strengths of its edges sum to at least
// EdgeDetectionOptions::min_contour_edges times the median strength. Mutual
// links join the edges of a contour.
std::vector<bool> AreSeedCandidates(const EdgeMap& map, const Options& options);

// One in input.h1_step of the unused edges of a view; for seeds only
// candidates. Ascending.
std::vector<std::int32_t> QueryEdges(const SketchInput& input,
                                     int view_idx,
                                     const UsedEdges& used);

// Number of links along a contour from one query edge to the next: two, four in
// crowded images, eight for seeds.
int LinksBetweenQueries(const SketchInput& input);

// Edges that are queried in two turns. Neighbours along a contour mostly have
// the same result, so the first turn tells which edges of the second are worth
// it.
struct TwoTurns {
  // At least `step` links apart along their contours.
  std::vector<std::int32_t> first;
  // Fewer than `step` links from an edge of `first`.
  std::vector<std::int32_t> second;
};

// Splits `edge_idxs`, in their order; `neighbors` by edge index; `step` >= 2.
// Takes O(edges * step).
TwoTurns SplitAlongContours(const std::vector<std::int32_t>& edge_idxs,
                            const std::vector<EdgeNeighbors>& neighbors,
                            int step);

}  // namespace curvix
