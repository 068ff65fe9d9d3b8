// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How far samples of curves may be off.
#pragma once

#include <curvix/curves.h>
#include <vector>

#include "curve_refinement/refinement_input.h"
#include "curve_refinement/response_curve.h"

namespace curvix {

// Sets the covariance and the sigma of each sample from how well the views
// agree about the segment of the curve around it. Errors of 2D edges go on
// along an edge, so a view counts as one measurement: the mean distance of its
// edges, without their blur (response_curve.h, in images of this response
// curve), from the projected segment, with weights that fall off as a Gaussian
// of standard deviation input.options.smoothing_px, or one pixel. The
// covariance is
//   s^2 A^-1 (sum_vw rho_vw a_v a_w^T) A^-1,  A = sum_v a_v a_v^T,
// where a_v is how fast the distance in view v grows, in pixels per world unit,
// rho_vw the correlation of two views, which falls with the angle between their
// rays, and s the standard deviation of the mean distances, robustly (Huber's,
// for Cauchy's loss of input.edge_sigma_px); where few views see the segment, s
// leans on that of all curves together.
//
// What all views have in common, as when all poses are off alike, is not in
// it. Samples without two views that cross stay as they are.
std::vector<Curve> EstimateCovariances(std::vector<Curve> curves,
                                       const RefinementInput& input,
                                       const ResponseCurve& response);

}  // namespace curvix
