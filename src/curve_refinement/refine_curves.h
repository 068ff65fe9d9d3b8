// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). From traced curves to curves as one would draw them.
#pragma once

#include <curvix/curves.h>
#include <vector>

#include "curve_refinement/refinement_input.h"

namespace curvix {

// Nine steps: selects (select_curves.h), smooths (smooth_curves.h), separates
// curves that touch (separate_touching.h), closes gaps (bridge_gaps.h), fits to
// all images (fit_to_images.h, response_curve.h), cuts at touches and at
// corners (cut_at_touches.h, cut_corners.h), carries ends on to corners
// (meet_at_junctions.h), drops curves shorter than input.options.min_length_px
// unless they join two junctions, and estimates covariances
// (estimate_covariances.h). Occluding contours that options keep are smoothed,
// not fitted. Without input.options.enabled, the curves as they are. Between
// steps, and between curves in the longest, input.step_done is asked.
std::vector<Curve> RefineCurves(const std::vector<Curve>& curves,
                                const RefinementInput& input);

}  // namespace curvix
