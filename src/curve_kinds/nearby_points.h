// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Where curves and points near a place on a curve lie:
// on the surfaces that meet there.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "curve_kinds/strips.h"
#include "model/posed_view.h"

namespace curvix {

// How far the nearest of the `positions` on other curves is in each direction;
// those a few pixels (of length `pixel`, world units) beside the plane across
// the curve count. Infinity without any.
CurveDistances DistancesByDirection(
    const StripPlace& place,
    double pixel,
    const std::vector<Eigen::Vector3d>& positions);

// Adds what points nearby say: a point in the direction of a surface speaks
// for it, one in another direction against it. `points` are on other curves or
// COLMAP's, `pixel` is the length of a pixel at the place, world units.
void AddNearbyPoints(const StripPlace& place,
                     double pixel,
                     const std::vector<PosedView>& views,
                     const std::vector<Eigen::Vector3d>& points,
                     SurfaceEvidence* evidence);

}  // namespace curvix
