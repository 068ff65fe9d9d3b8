// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). From traced curves to curves as one would draw them.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Selects (select_curves.h), smooths (smooth_curves.h), closes gaps
// (bridge_gaps.h), fits to all images (fit_to_images.h) under the response
// curve that the views agree on (response_curve.h, unless
// options.undo_response_curve is off), and carries on to corners
// (meet_at_junctions.h). Then curves shorter than options.min_length_px go,
// unless they lead from one junction to another. `edge_sigma_px`: the standard
// deviation of a 2D edge's place that the sigmas of `curves` assume, > 0.
std::vector<Curve> RefineCurves(const std::vector<Curve>& curves,
                                const std::vector<PosedView>& views,
                                const std::vector<EdgeMap>& edge_maps,
                                double edge_sigma_px,
                                const CurveRefinementOptions& options,
                                int num_threads);

}  // namespace curvix
