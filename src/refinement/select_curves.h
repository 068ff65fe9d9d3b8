// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Which curves are edges of the scene.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>

#include <vector>

#include "model/posed_view.h"

namespace curvix {

struct SelectedCurves {
  std::vector<Curve> edges;
  std::vector<Curve> occluding_contours;  // labelled
};

// Sorts the curves, each kind in the given order. A curve (curve_traits.h) is
//  * an occluding contour, if
//      dilution * max(1, s / r) > allowed
//    with s its scatter, r that of good curves of this scene, and allowed
//    options.max_dilution; where views cannot tell places so well, 6 times the
//    least dilution, up to 1.6 options.max_dilution; of crowded images
//    (AreCrowded()), 15 times the least dilution,
//  * an edge of the scene, if also
//      dilution * max(1, s / r) <= allowed * (1 - blurred / max_blurred_share)
//    or options.max_blurred_share is 1,
//  * left out as a border of shading, otherwise.
// The rim of a smooth body lies elsewhere in every view, so its edges scatter,
// and shows from directions in one plane, so it is badly determined; what views
// show by chance scatters, too. r is what is left of the errors of edges,
// cameras and poses: the lower quartile of the scatter of the sharpest curves,
// weighted by length / dilution^2; at least 0.06 px, which sampling by pixels
// leaves. Curves whose sigma is not known or that have no support count as
// edges; if options.max_dilution is 0, all do. `edge_sigma_px`: as of
// MeasureCurve().
SelectedCurves SelectCurves(std::vector<Curve> curves,
                            const std::vector<PosedView>& views,
                            const std::vector<EdgeMap>& edge_maps,
                            double edge_sigma_px,
                            const CurveRefinementOptions& options,
                            int num_threads);

}  // namespace curvix
