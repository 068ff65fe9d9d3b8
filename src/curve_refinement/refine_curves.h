// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). From traced curves to curves as one would draw them.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Nine steps: selects (select_curves.h), smooths (smooth_curves.h), separates
// curves that touch (separate_touching.h), closes gaps (bridge_gaps.h), fits to
// all images (fit_to_images.h, response_curve.h), cuts at touches and at
// corners (cut_at_touches.h, cut_corners.h), carries ends on to corners
// (meet_at_junctions.h), drops curves shorter than options.min_length_px unless
// they join two junctions, and estimates covariances
// (estimate_covariances.h). Occluding contours that options keep are smoothed,
// not fitted. Without options.enabled, the curves as they are. `edge_sigma_px`:
// the standard deviation of a 2D edge that the sigmas of `curves` assume, > 0.
std::vector<Curve> RefineCurves(const std::vector<Curve>& curves,
                                const std::vector<PosedView>& views,
                                const std::vector<EdgeMap>& edge_maps,
                                double edge_sigma_px,
                                const CurveRefinementOptions& options,
                                int num_threads);

}  // namespace curvix
