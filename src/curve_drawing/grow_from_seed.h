// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). One curve, from its seed on.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <optional>
#include <vector>

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

}  // namespace curvix
