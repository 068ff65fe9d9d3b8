// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 and 4. The loop as in the paper.
#pragma once

#include "edge_sketch/sketch_input.h"

namespace curvix {

// The pairs of views with most unused edges, support in wedges.
EdgeSketch SketchByPairs(const SketchInput& input, const StepDone& step_done);

}  // namespace curvix
