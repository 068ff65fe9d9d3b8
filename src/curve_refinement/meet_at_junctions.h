// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Sharp corners.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Carries curves on to the corners at which they meet. An edge detector rounds
// corners by its own width, so the last pixels before one are missing or bent:
// each open end is continued along the line or arc (curve_ends.h) fitted to the
// samples 2.5 to 20 px before it, or nearly all of a curve too short for that.
// Ends that so pass each other, no more than 1.5 px from the point nearest to
// all their tangents there, at most options.junction_reach_px and the length of
// the fitted samples from both and at more than 10 degrees, form a junction:
// that point. The curves are cut 2.5 px before their ends and carried on to it:
// samples of one junction are equal to the last bit. Junctions are formed by
// rising gap, ties by the order of curves; an end belongs to one junction. Ends
// in one place that continue each other, as where curves touch
// (cut_at_touches.h), stay. Pixels as in pixel_size.h.
std::vector<Curve> MeetAtJunctions(std::vector<Curve> curves,
                                   const std::vector<PosedView>& views,
                                   const CurveRefinementOptions& options,
                                   int num_threads);

}  // namespace curvix
