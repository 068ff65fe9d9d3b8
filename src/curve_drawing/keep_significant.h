// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Selection of grown curves.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/options.h>
#include <cstdint>
#include <vector>

#include "edge_sketch/view_index.h"

namespace curvix {

struct GrownCurve {
  Curve curve;  // with the log-likelihood ratio of each sample
  // Number of queries: views and samples in which the prediction was certain
  // enough.
  std::int64_t num_looks = 0;
};

// The median crowding (Edge2d::crowding) of some 2D edges; 0 of none. `indices`
// by view.
double MedianCrowding(const std::vector<EdgeRef>& edges,
                      const std::vector<ViewIndex>& indices);

// Drops what may be there by chance, and texture:
//  - curves whose significance is below options.min_significance: the sum of
//    their log-likelihood ratios (evidence.h) over the square root of the
//    number of queries, which is proportional to what chance gives, times the
//    mean strength of their 2D edges over that of all curves. Weak edges are
//    more often reflections, shading, noise and compression artifacts. Without
//    any strength, that factor is 1;
//  - curves whose edges have a MedianCrowding() above options.max_crowding and
//    whose significance is below four times that.
//
// `indices` by view. The others stay in their order.
std::vector<Curve> KeepSignificant(std::vector<GrownCurve> curves,
                                   const std::vector<ViewIndex>& indices,
                                   const CurveGrowthOptions& options);

}  // namespace curvix
