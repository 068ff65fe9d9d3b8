// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). What the steps of curve refinement know beside the
// curves.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <cstddef>
#include <functional>
#include <vector>

#include "base/cancelled.h"
#include "base/parallel.h"
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
  StepDone step_done = {};

  bool Stops() const { return step_done && !step_done(0, 0); }
};

// ParallelFor over curves that ends early if input.Stops().
inline void ForEachCurve(std::size_t num_curves,
                         const RefinementInput& input,
                         const std::function<void(std::size_t)>& f) {
  ParallelForWhile(
      num_curves,
      input.num_threads,
      [&](std::size_t i) {
        f(i);
        return true;
      },
      [&](std::size_t) { return !input.Stops(); });
}

}  // namespace curvix
