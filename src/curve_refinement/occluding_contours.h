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
#include <curvix/edges.h>
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
                                 const ImageSupport& images,
                                 double edge_sigma_px);

// Curves that are a side of a round bar: pipe, rail, cable, leg of a chair. It
// shows two occluding contours, a radius to either side of its axis, from
// wherever it is seen. The two edges of a flat bar stay where they are instead.
// A radius of a few pixels moves one contour by less than the poses may err;
// both contours together tell it.
//
// Makes such curves CurveKind::kOccludingContour, all samples, if the 2D edges
// about them are e^3 times likelier with two contours than with edges in space,
// geometric mean over places; the probability is by that ratio. Radii are 1 to
// 16 px. Curves that are occluding contours already stay so. One edge map per
// view; `edge_sigma_px`: the standard deviation of a 2D edge's place, > 0.
void LabelRoundBars(const std::vector<PosedView>& views,
                    const std::vector<EdgeMap>& edge_maps,
                    double edge_sigma_px,
                    int num_threads,
                    std::vector<Curve>* curves);

}  // namespace curvix
