// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Whole curves.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "curve_refinement/image_support.h"
#include "model/posed_view.h"

namespace curvix {

// Joins open ends that continue each other at their own curvature: an arc
// (curve_ends.h) is fitted to the last 15 to 60 px before each end, as far as
// it fits, and carried on over the gap it must come within 1 px plus a tenth of
// the gap of the other end, at less than 15 degrees from its direction; from
// both sides. Gaps are no longer than what was fitted, nor than
// options.max_gap_px, except where the images show the curve in the gap: four
// fifths of the samples that would fill it have at least half as many 2D edges
// as the worse supported end. The ends that are missed least come first, 20 px
// of gap counting as one of miss; ties by the order of curves. Bent last
// samples and overlaps of up to 6 px are cut off. The gap is filled with
// samples on the cubic that fits both ends; they have the sigma and evidence of
// the weaker end, and the 2D edges within 1 px. Curves whose own ends meet so
// become closed. Pixels as in pixel_size.h.
std::vector<Curve> BridgeGaps(std::vector<Curve> curves,
                              const std::vector<PosedView>& views,
                              const ImageSupport& images,
                              const CurveRefinementOptions& options,
                              int num_threads);

}  // namespace curvix
