// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 and 4. The loop of the default.
#pragma once

#include "edge_sketch/sketch_input.h"

namespace curvix {

// Every view with its partners, tracked support.
// Deviation: the paper takes pairs of views (paper/sketch_by_pairs.h).
EdgeSketch SketchByViews(const SketchInput& input, const StepDone& step_done);

// The same in two steps: all 3D edges with enough support, then without those
// that others explain (exclusive_support.h). The second step needs no indices:
// with many views, these are freed before, since both take much memory.
EdgeSketch TrackByViews(const SketchInput& input, const StepDone& step_done);
void DropExplained(const SketchInput& input, EdgeSketch& sketch);

}  // namespace curvix
