// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). How likely the 2D edges beside a curve are if a view
// shows a contour there.
#pragma once

#include <vector>

namespace curvix {

// Along a curve, from one place at which its contours are compared to the next.
constexpr double kPlaceSpacingPx = 15;

// From a contour `at_px` beside the curve to the nearest of `edges_px`, signed
// distances from the curve, ascending; infinite without any.
double NearestResidual(const std::vector<double>& edges_px, double at_px);

// Of an edge this far from where a contour is expected, over that of other
// edges, of which there are `density` per pixel; 0 if the residual is infinite.
double LogLikelihoodOfContour(double residual_px,
                              double sigma_px,
                              double density);

// Contours per pixel across the curve, from the number of edges found at most
// `reach_px` beside it in all views.
double DensityOfContours(double num_edges, double num_views, double reach_px);

}  // namespace curvix
