// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3 ("overlapping views"), which does not define overlap.
// Deviation: sparse points where there are any, else the cameras' geometry.
#pragma once

#include <curvix/scene.h>
#include <Eigen/Core>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// How much view `other` sees of what a view sees.
struct ViewOverlap {
  int other = 0;             // view_idx
  double share = 0;          // of the places of the view, 0..1
  double ray_angle_rad = 0;  // median angle between the rays to these places
  // From the view's centre to the other's, across the view's line of sight.
  // Unit, or zero where the other view lies on the line of sight.
  Eigen::Vector3d baseline_across = Eigen::Vector3d::Zero();
};

// The places that each view sees: up to 64 of its sparse points, if it has
// eight or more; else a grid in its image at its working depth, which is the
// median, over the 64 nearest cameras, of the depth at which its optical axis
// passes nearest to theirs. O(n log n) for n views.
std::vector<std::vector<Eigen::Vector3d>> FindPlaces(
    const std::vector<PosedView>& views, const std::vector<ScenePoint>& points);

// For each view the views that overlap it, by view_idx: those that see some of
// its places. Views with the same centre do not overlap, since they see no
// depth together. The time grows with the number of overlapping pairs.
std::vector<std::vector<ViewOverlap>> FindOverlaps(
    const std::vector<PosedView>& views, const std::vector<ScenePoint>& points);

}  // namespace curvix
