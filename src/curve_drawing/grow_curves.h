// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). In place of Secs. 5 and 6: curves that grow from 3D
// edges along the contours of the images.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/options.h>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/cancelled.h"
#include "edge_sketch/evidence.h"
#include "edge_sketch/sketch_input.h"
#include "edge_sketch/view_index.h"
#include "model/posed_view.h"

namespace curvix {

struct GrownCurve {
  Curve curve;  // with the log-likelihood ratio of each sample
  // Number of queries: views and samples in which the prediction was certain
  // enough.
  std::int64_t num_looks = 0;
};

// What a seed grew into.
struct Growth {
  std::optional<GrownCurve> curve;  // none: it is too short, or there already
  // All 2D edges that were found, also those that the curve dropped. While none
  // of them is claimed, growing again gives the same curve.
  std::vector<EdgeRef> found;
};

// The input of GrowCurves(). All references must outlive it.
struct GrowthInput {
  const std::vector<PosedView>& views;
  const std::vector<EdgeMap>& edge_maps;  // by view
  const std::vector<ViewIndex>& indices;  // by view
  const NeighborsByView& neighbors;       // by view
  double edge_sigma_px = 0;
  const CurveGrowthOptions& options;
  const ValidationOptions& validation;  // which edges are near enough
};

// Grows a curve from `seed` over edges that are not `claimed`, and claims none.
Growth GrowFromSeed(const Edge3d& seed,
                    const GrowthInput& input,
                    const UsedEdges& claimed);

// Grows a curve from each seed, in the order of falling log-likelihood ratio
// (ties: the smaller position, by its coordinates), unless earlier curves have
// most of its 2D edges.
//
// From the seed, in both directions, the curve steps along its tangent
// (CurveTip) by about a pixel. Each view is queried for the nearest edge at the
// projection, within the same bounds as for a 3D edge (WidestGate()), among
// those that no earlier curve has. Edges that look unlike those of neighbouring
// views (AppearanceRatio()) do not support the curve. Views that show the curve
// steadily correct the tip; views in which the prediction is too uncertain do
// not count. A sample is supported if enough such views show it and its
// log-likelihood ratio (evidence.h) is a fair share of the mean of the curve so
// far. A curve ends at its last supported sample before a long gap; it is
// closed where it returns to its seed.
//
// Curves that KeepSignificant() drops keep their edges from other curves. The
// uncertainty of a position does not matter: a curve goes on where images show
// it. The sigma of a sample is that of a 3D edge with the same support, before
// short streaks of hits are dropped.
//
// The curves are in the order of their seeds. `step_done` counts these.
std::vector<Curve> GrowCurves(const std::vector<Edge3d>& seeds,
                              const GrowthInput& input,
                              int num_threads,
                              const StepDone& step_done = {});

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
