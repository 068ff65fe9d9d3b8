// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Whole curves.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "curve_refinement/image_support.h"
#include "model/posed_view.h"

namespace curvix {

// Joins open ends that continue each other at their own curvature: the arcs
// that fit before the two ends (curve_ends.h), carried on over the gap, arrive
// at each other's ends. Gaps are no longer than what was fitted, nor than
// options.max_gap_px, except where the images show the curve in the gap. The
// ends that are missed least come first; ties by the order of curves. Bent last
// samples and overlaps of joined ends are cut off; other ends keep them, since
// most are contours of the images. The gap is filled with samples on the cubic
// that fits both ends; they have the sigma and evidence of the weaker end, and
// the 2D edges nearby. A curve whose own ends meet becomes closed.
std::vector<Curve> BridgeGaps(std::vector<Curve> curves,
                              const std::vector<PosedView>& views,
                              const ImageSupport& images,
                              const CurveRefinementOptions& options,
                              int num_threads);

}  // namespace curvix
