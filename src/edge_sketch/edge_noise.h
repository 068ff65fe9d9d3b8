// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How far 2D edges are off in this scene.
#pragma once

#include "edge_sketch/sketch_input.h"

namespace curvix {

// The standard deviation of the distance of 2D edges from the 3D edges that
// they support: what noise, blur, lens and poses leave. From a sketch of a few
// thousand of the edges, by the median distance from where a contour of any
// radius agrees best, so that occluding contours of smooth bodies do not count
// as noise. At least options.hypotheses.EdgeSigmaPx(), which is returned, too,
// if too few 3D edges are found; renders with exact poses have less. Pixels.
// `step_done` is asked whether to go on.
double EstimateEdgeSigma(const SketchInput& input, const StepDone& step_done);

}  // namespace curvix
