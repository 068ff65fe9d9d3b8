// SPDX-License-Identifier: BSD-3-Clause
// Better poses from the edges themselves: without sparse points, without
// texture.
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
  // Of projected samples that were held out from the nearest edges of like
  // direction, 1 where there is none within a pixel; the samples are fitted to
  // the poses before and to those after.
  ErrorsOfViews before;
  ErrorsOfViews after;
  std::size_t num_points = 0;        // sparse points that took part
  std::size_t num_check_points = 0;  // held out to judge by
  // Of the points held out from where they are seen, cut at 2 px; fitted to the
  // poses before and to those after.
  ErrorsOfViews points_before;
  ErrorsOfViews points_after;
  // How far the gain of what is held out stands out of chance; see
  // RefinePosesWithCurves.
  double significance = 0;
  std::size_t num_views_moved = 0;  // views that the new poses serve better
  // How far the samples that a view sees, at their places before, shift in its
  // image: the median over these samples; of all views the median and the
  // largest.
  double median_shift_px = 0;
  double max_shift_px = 0;
  std::size_t max_shift_view_idx = 0;
};

// Adjusts poses and samples of curves together, so that the samples project
// onto the edges of the views, and finds the edges anew as the poses get
// better. Poses may be off by several pixels. Cameras stay as they are. The
// world keeps its place and scale but for what the mean of all poses tells: a
// prior as wide as poses turn out to be off holds each where it was.
// One fifth of space is held out to judge by. A view in which the samples held
// out do not come nearer to their edges keeps its pose; so do all if the mean
// distance falls by less than 15 %. Poses are taken as they are, without much
// ado, if the median distance is below 0.06 px and no view's picture fits
// clearly better shifted. The same result for any number of threads.
// kInvalidArgument as ReconstructCurves. `progress` is called as stage
// "refine_poses_with_curves"; kCancelled when it returns false.
Result<CurvePoses> RefinePosesWithCurves(const Scene& scene,
                                         const std::vector<EdgeMap>& edge_maps,
                                         const Options& options,
                                         const Progress& progress = {},
                                         bool refine_intrinsics = true);

// The edges of a scene as other cameras have them, in the same order. Cameras
// and edges must be as many as the scene's. kInvalidArgument if a camera cannot
// be inverted at an edge.
Result<std::vector<EdgeMap>> EdgesWithCameras(
    const Scene& scene,
    const std::vector<EdgeMap>& edge_maps,
    const std::vector<Camera>& cameras);

}  // namespace curvix
