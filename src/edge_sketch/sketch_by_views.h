// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 and 4. The loop of the default.
#pragma once

#include "edge_sketch/sketch_input.h"

namespace curvix {

// Every view with its partners, tracked support.
// Deviation: the paper takes pairs of views (paper/sketch_by_pairs.h).
EdgeSketch SketchByViews(const SketchInput& input, const StepDone& step_done);

}  // namespace curvix
