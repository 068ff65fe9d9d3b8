// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What the steps of curve refinement know beside the
// curves.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// All of it outlives the bundle.
struct RefinementInput {
  const std::vector<PosedView>& views;
  const std::vector<EdgeMap>& edge_maps;  // one per view
  // The standard deviation of a 2D edge's place that the sigmas of the curves
  // assume. Pixels, > 0.
  double edge_sigma_px;
  const CurveRefinementOptions& options;
  int num_threads;
};

}  // namespace curvix
