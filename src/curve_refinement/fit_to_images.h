// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Whole curves on the edges of all images.
#pragma once

#include <curvix/curves.h>
#include <vector>

#include "curve_refinement/refinement_input.h"
#include "curve_refinement/response_curve.h"

namespace curvix {

// Moves the samples of each curve across it to where they best agree with all
// their 2D edges in all views, under the assumption that curves bend evenly:
// the least, by Ceres, of
//   sum rho1(d / input.edge_sigma_px) + sum rho2(b^3 |x'''| / (0.05 px)),
// where d is the distance of a projected sample from the line of its 2D edge,
// which stands where it would without blur (response_curve.h, in images of
// this response curve), b is 1.2 input.options.smoothing_px, x''' is the third
// derivative by arc length of four samples in a row, small for all smooth
// curves, and the losses are Cauchy's: a wrong 2D edge hardly pulls, and a kink
// that the images show stays. So noise goes on lengths of some b and curvature
// stays. In a weak direction (weak_directions.h) images show no kink: there, b
// is larger by the ratio of the standard deviations, at most by three, and
// rho2 is the square. Tangents become those of the samples five in a row.
// Curves of fewer than six samples stay; smoothing_px = 0 returns the input.
// Samples that come to lie 2 px or more from their 2D edges (median) are cut
// out; what is left of a curve is one or several, in order.
// Pixels in space as in pixel_size.h.
std::vector<Curve> FitToImages(std::vector<Curve> curves,
                               const RefinementInput& input,
                               const ResponseCurve& response);

}  // namespace curvix
