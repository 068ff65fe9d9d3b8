// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). In place of Secs. 5 and 6: curves that grow from 3D
// edges along the contours of the images.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <vector>

#include "curve_drawing/grow_from_seed.h"

namespace curvix {

// Grows a curve from each seed, in the order of falling log-likelihood ratio
// (ties: the smaller position, by its coordinates), unless earlier curves have
// most of its 2D edges.
//
// From the seed, in both directions, the curve steps along its tangent
// (CurveTip): by one pixel of the supporting view that sees the step largest,
// but at most by four times the seed's PixelSize(). Each view is queried for
// the nearest edge at the projection, within the same bounds as for a 3D edge
// (WidestGate()), among those that no earlier curve has.
// Views that support the curve three times in a row correct the tip, until they
// miss it three times in a row; views in which the prediction is too uncertain
// count neither way. A sample is supported if at least three such views support
// it and its log-likelihood ratio (evidence.h) is at least 0.3 times the mean
// of the curve so far. A curve ends at its last supported sample before a gap
// of more than 10 px; it is closed where it returns to its seed.
//
// Curves that KeepSignificant() drops keep their edges from other curves. The
// uncertainty of a position does not matter: a curve goes on where images show
// it. The sigma of a sample is that of a 3D edge with the same support, before
// short streaks of hits are dropped.
//
// The curves are in the order of their seeds.
std::vector<Curve> GrowCurves(const std::vector<Edge3d>& seeds,
                              const GrowthInput& input,
                              int num_threads);

}  // namespace curvix
