// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves that are a side of a round bar: pipe, rail,
// cable, leg of a chair.
//
// A round bar shows two occluding contours, a radius to either side of its
// axis, from wherever it is seen. The two edges of a flat bar stay where they
// are instead. A radius of a few pixels moves one contour by less than the
// poses may err; both contours together tell it.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Makes such curves CurveKind::kOccludingContour, all samples, if the 2D edges
// about them are likelier with two contours than with edges in space; the
// probability is by that ratio. Radii are 1 to 16 px. Curves that are occluding
// contours already stay so. One edge map per view; `edge_sigma_px`: the
// standard deviation of a 2D edge's place, > 0.
void LabelRoundBars(const std::vector<PosedView>& views,
                    const std::vector<EdgeMap>& edge_maps,
                    double edge_sigma_px,
                    int num_threads,
                    std::vector<Curve>* curves);

}  // namespace curvix
