// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3 ("overlapping views"), which leaves open how overlap is known.
// Deviation: sparse points where there are any, else the cameras' geometry.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// How well view `other` sees what a view sees.
struct ViewOverlap {
  int other = 0;             // view_idx
  double share = 0;          // of the places of the view, 0..1
  double ray_angle_rad = 0;  // median angle between the rays to these places
  // From the view's centre to the other's, across the view's line of sight.
  // Unit, or zero where the other view lies on the line of sight.
  Eigen::Vector3d baseline_across = Eigen::Vector3d::Zero();
};

// The places that each view sees: where it sees at least eight sparse points,
// up to 64 of these, else a grid in its image at its working depth: the median,
// over the 64 nearest cameras, of the depth at which its optical axis passes
// nearest to theirs. Time: views times their logarithm.
std::vector<std::vector<Eigen::Vector3d>> FindPlaces(
    const std::vector<PosedView>& views, const std::vector<ScenePoint>& points);

// For each view the views that overlap it, by view_idx: those that see some of
// its places. Views at one and the same place do not overlap: together they see
// no depth. Time: pairs that overlap, and some around them.
std::vector<std::vector<ViewOverlap>> FindOverlaps(
    const std::vector<PosedView>& views, const std::vector<ScenePoint>& points);

}  // namespace curvix
