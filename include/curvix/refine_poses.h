// SPDX-License-Identifier: BSD-3-Clause
// Better poses and cameras from the edges themselves: with sparse points or
// without, and without texture.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/reconstruct.h>
#include <curvix/scene.h>
#include <curvix/status.h>

#include <cstddef>
#include <string>
#include <vector>

namespace curvix {

// Distances in pixels.
struct ErrorsOfViews {
  double mean_px = 0;
  double median_px = 0;
};

struct CurvePoses {
  // Refined if accepted, else those of the scene; by view and by camera.
  std::vector<Rigid3> cam_from_world;
  std::vector<Camera> cameras;
  bool accepted = false;
  std::string reason;  // why, or why not: part of a sentence, no full stop
  std::size_t num_samples = 0;        // places on curves that took part
  std::size_t num_check_samples = 0;  // held out to judge by
  std::size_t num_check_observations = 0;
  // Distances of held-out samples, projected, from the nearest edges of like
  // direction; 1 where there is none within a pixel. The samples are fitted
  // anew to the old poses (before) and to the new ones (after). These numbers
  // and errors, and those of points below, are of the fifth that is held out
  // first.
  ErrorsOfViews before;
  ErrorsOfViews after;
  std::size_t num_points = 0;        // sparse points that took part
  std::size_t num_check_points = 0;  // held out to judge by
  // Distances of held-out points, projected, from their pixels, at most 2 px.
  // The points are fitted anew to the old and to the new poses.
  ErrorsOfViews points_before;
  ErrorsOfViews points_after;
  // z: the gain of the held-out data, of all fifths that were tested, over its
  // standard deviation if gains and losses were equally likely; see
  // RefinePosesWithCurves.
  double significance = 0;
  // Views with another pose or camera; if refused, those that would have one.
  std::size_t num_views_moved = 0;
  // How far samples at their old positions shift in an image when its pose
  // changes: the median over the samples that the view sees. Of these medians,
  // the median and the largest over all views.
  double median_shift_px = 0;
  double max_shift_px = 0;
  std::size_t max_shift_view_idx = 0;
};

// Adjusts poses, cameras, samples of curves and the scene's points together, so
// that the samples project onto the edges of the views and the points onto
// their pixels, and finds the edges anew as the poses get better. Points take
// part if a hundred have pixels. Poses may be off by several pixels. The world
// keeps the unit that samples and points have, and stays where the poses of the
// scene show it.
// Cameras change if `refine_intrinsics`, whether views share them or not: all
// with enough observations, or none. Their first eight parameters change, or
// those of a model with more terms (SIMPLE_RADIAL, RADIAL, OPENCV; of fisheyes
// the same with _FISHEYE). None change if one of the new cameras cannot be
// inverted at an edge.
//
// Held out are a fifth of space, and of the points every fifth and those that
// no view needs. A gain of test data is significant if its probability under
// equal chances of gain and loss is below 1 in 9000; a run judges nine times at
// most. As long as what is held out leaves open if the poses are better, other
// fifths are held out as well, and their gains count, too.
//  * New cameras, which two fifths of space determine, are taken if poses
//    adjusted to all other data fit it significantly better with them.
//  * All is accepted if the held-out data fits significantly better, or no
//    worse with new cameras, and neither samples nor points are significantly
//    worse. If no camera has changed, a view that fits worse keeps its pose.
//  * Then poses are adjusted to all data.
// Poses stay as they are if the median distance is below 0.06 px: that of the
// samples, if no image fits clearly better when it is shifted, or that of the
// points in every view. docs/stages/poses.md says more.
//
// The same result for any number of threads. kInvalidArgument as
// ReconstructCurves. `progress` is called as stage "refine_poses_with_curves";
// kCancelled when it returns false.
Result<CurvePoses> RefinePosesWithCurves(const Scene& scene,
                                         const std::vector<EdgeMap>& edge_maps,
                                         const Options& options,
                                         const Progress& progress = {},
                                         bool refine_intrinsics = true);

// The edges of a scene as other cameras have them, in the same order. There
// must be as many edge maps as views, and at least as many cameras as the scene
// has. kInvalidArgument if not, or if a camera cannot be inverted at an edge.
Result<std::vector<EdgeMap>> EdgesWithCameras(
    const Scene& scene,
    std::vector<EdgeMap> edge_maps,
    const std::vector<Camera>& cameras);

}  // namespace curvix
