// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Whether a curve is where a round body turns away.
//
// Views from nearly the same side see the occluding contour of a body in nearly
// the same place, and agree on a curve. Views from further round see it beside
// that curve: of a cylinder, by radius * (1 - cos(angle)). Edges of the scene
// beside a curve do not follow such a law. So all views are asked, those above
// all that do not support the curve.
#pragma once

#include <curvix/curves.h>
#include <vector>

#include "curve_refinement/image_support.h"
#include "model/posed_view.h"

namespace curvix {

// The logarithm of how many times likelier the 2D edges about the curve are if
// it is an occluding contour of a cylinder, of the radius that fits best, than
// if it is an edge, with or without another edge beside it: the mean over
// places of the curve 15 px apart. Radii are 3 to 400 px; 2D edges further than
// 8 px from the projected curve are not looked at. 0 where no view has an edge
// beside the curve. `edge_sigma_px`: the standard deviation of a 2D edge's
// place, > 0.
double ContourLogLikelihoodRatio(const Curve& curve,
                                 const std::vector<PosedView>& views,
                                 const ImageSupport& images,
                                 double edge_sigma_px);

}  // namespace curvix
