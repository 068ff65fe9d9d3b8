// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 and 4. The loop of the default and, beyond the paper, the
// standard deviation of 2D edges that it takes.
#pragma once

#include <curvix/edges.h>

#include "base/cancelled.h"
#include "edge_sketch/sketch_input.h"

namespace curvix {

// Every view with its partners, tracked support.
// Deviation: the paper takes pairs of views (paper/sketch_by_pairs.h).
EdgeSketch SketchByViews(const SketchInput& input, const StepDone& step_done);

// The same in two steps: all 3D edges with enough support, then without those
// that others explain (exclusive_support.h). The second step needs no indices:
// with many views, these are freed before, since both take much memory.
EdgeSketch TrackByViews(const SketchInput& input, const StepDone& step_done);
void DropExplained(const std::vector<PosedView>& views,
                   const std::vector<EdgeMap>& edge_maps,
                   const ValidationOptions& options,
                   EdgeSketch& sketch);

// The standard deviation of the distance of 2D edges from the 3D edges that
// they support, due to noise, blur, lens and poses. Pixels. Found in a sketch
// of a few thousand edges, from the median distance from the best-fitting
// contour of any radius, so that occluding contours of smooth bodies do not
// count as noise. At least input.sigma_px, which is also the result if too few
// 3D edges have four supports or more. With four or five views it is up to a
// quarter too small: 3D edges with large errors are not found, and the
// residuals of so few supports depend on each other. `step_done` may stop it.
double EstimateEdgeSigma(const SketchInput& input, const StepDone& step_done);

}  // namespace curvix
