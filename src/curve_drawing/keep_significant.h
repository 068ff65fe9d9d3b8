// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Which grown curves exist.
#pragma once

#include <curvix/curves.h>
#include <cstdint>
#include <vector>

#include "edge_sketch/view_index.h"

namespace curvix {

struct GrownCurve {
  Curve curve;  // with the evidence of each sample
  // How often a view was asked for a sample of the curve and could tell.
  std::int64_t num_looks = 0;
};

// Leaves out the curves whose significance is below `min_significance`: the sum
// of their evidence (evidence.h) over the square root of the number of looks,
// as chance grows, times the mean strength of their 2D edges over that of all
// curves. Weak edges are more often reflections, shading, noise and the
// patterns of compression. Without any strength, that factor is 1.
//
// `indices` by view. The others stay in their order.
std::vector<Curve> KeepSignificant(std::vector<GrownCurve> curves,
                                   const std::vector<ViewIndex>& indices,
                                   double min_significance);

}  // namespace curvix
