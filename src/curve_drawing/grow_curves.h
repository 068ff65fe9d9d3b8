// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). In place of Secs. 5 and 6: curves that grow from 3D
// edges along the contours of the images.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <vector>

#include "curve_drawing/grow_from_seed.h"

namespace curvix {

// Grows a curve from each seed, those of most evidence first (ties: the smaller
// position, by its coordinates), unless earlier curves have most of its 2D
// edges.
//
// From the seed, and in both directions, the curve steps on along its tangent
// (CurveTip): by a pixel in the view, of those that show it there, that sees
// the step largest, but at most by four times the seed's PixelSize(). Each view
// is asked for the nearest edge where it should show the new place, of those
// that no earlier curve has. Views that have shown the curve three times in a
// row correct the tip, until they miss it three times; views that cannot tell
// do neither. A sample is shown if at least three such views support it and its
// evidence (evidence.h) is at least the share options.min_relative_evidence of
// the mean of the curve so far. A curve ends with its last shown sample before
// a stretch of more than options.max_gap_px without any; it is closed where it
// comes back to its seed.
//
// A curve exists if it is significant (keep_significant.h,
// options.min_significance); the others are left out, and their edges show no
// other curve. How surely its place is known has no part in that: the sigma of
// a sample is that of a 3D edge with the same support, before hits of too few
// in a row go.
//
// The curves are in the order of their seeds' evidence.
std::vector<Curve> GrowCurves(const std::vector<Edge3d>& seeds,
                              const GrowthInput& input,
                              int num_threads);

}  // namespace curvix
