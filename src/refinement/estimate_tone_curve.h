// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How the images' brightness answers to light.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>

#include <vector>

#include "model/posed_view.h"
#include "refinement/unblurred_edges.h"

namespace curvix {

// The tone curve with which the views agree best about the curves. A curve
// that some views see against the sky and others against a wall has an edge of
// another contrast and level in each, so a tone curve moves it by another
// amount in each, or to the other side; only what the samples, each by itself,
// cannot follow tells of it. Least squares with Cauchy's weights
// (`edge_sigma_px`) over samples some ten pixels apart, in turn with their
// places; neither parameter is below 0, since no camera's brightness grows
// faster than light; as if a little had been seen of a curve without tone, so
// that few curves change nothing.
ToneCurve EstimateToneCurve(const std::vector<Curve>& curves,
                            const std::vector<PosedView>& views,
                            const std::vector<EdgeMap>& edge_maps,
                            double edge_sigma_px,
                            int num_threads);

}  // namespace curvix
