// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3 ("overlapping views"), which does not define overlap.
// Deviation: sparse points where there are any, else the cameras' geometry.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/scene.h>
#include <Eigen/Core>
#include <vector>

#include "base/infinity.h"
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
// passes nearest to theirs.
std::vector<std::vector<Eigen::Vector3d>> FindPlaces(
    const std::vector<PosedView>& views, const std::vector<ScenePoint>& points);

// Of the overlaps of one view, by view_idx, that with `other`; nullptr: none.
const ViewOverlap* OverlapWith(const std::vector<ViewOverlap>& overlaps,
                               int other);

using Overlaps = std::vector<std::vector<ViewOverlap>>;  // by view_idx

// For each view the views that overlap it, by view_idx: those that see some of
// its places. Views with the same centre do not overlap.
Overlaps FindOverlaps(const std::vector<PosedView>& views,
                      const std::vector<ScenePoint>& points);

struct DistinctViews {
  std::vector<bool> are_repeated;  // by view: another one shows the same
  Overlaps overlaps;               // among the others
  // By view: the first view of its station. A station is a set of views from
  // one place.
  std::vector<int> stations;
  // By view: those of its station that come before it, first ones first.
  std::vector<std::vector<int>> before_at_station;
};

// None repeated, and each a station of its own.
DistinctViews AllDistinct(Overlaps overlaps);

// Two views repeat each other if each sees nine tenths of the places of the
// other at a median ray angle below options.validation.min_view_angle_deg:
// neighbouring frames of a video, say. They show the same edges wherever these
// are in depth, so together they confirm no more than one of them does. In the
// order of falling numbers of sparse points (ties: of edges, then by view_idx),
// each view that is left and has edges leaves out those that repeat it. Views
// that see less of the same remain but do not overlap.
//
// Views that are left form stations, sets of views from one place: photographs
// of a panorama, zoomed ones from a tripod, pieces of one image. In the same
// order, each view without a station opens one, and takes the views without a
// station whose distance from it, divided by the smaller median distance of
// their places, is below that angle in radians. Where several views of a
// station see an edge, only the first is queried. With 0, and without
// ViewSelection::kEveryView, none is repeated, the overlaps are those of
// FindOverlaps(), and each view is a station.
DistinctViews FindDistinctViews(const std::vector<PosedView>& views,
                                const std::vector<EdgeMap>& edge_maps,
                                const std::vector<ScenePoint>& points,
                                const Options& options);

// Depths along a view's optical axis, world units. The default is all of them.
struct DepthRange {
  double nearest = 0;
  double farthest = kInfinity;
};

// Deviation: sparse points bound the depth; the paper searches whole epipolar
// lines. For each view, by view_idx, the depths at which edges are searched:
// those of its sparse points without the two nearest and the two farthest,
// which may be wrong, extended by `margin` of their range on either side. The
// range is one of inverse depths, in which epipolar lines are uniform; it is at
// least a fifth of their median, so that a flat scene has one. All depths for a
// view of fewer than 16 points, and for all views if `margin` is 0.
std::vector<DepthRange> FindDepthRanges(const std::vector<PosedView>& views,
                                        const std::vector<ScenePoint>& points,
                                        double margin);

}  // namespace curvix
