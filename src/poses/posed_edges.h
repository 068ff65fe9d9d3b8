// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The edges of views whose poses and cameras change,
// and places on curves: samples with the 2D edges that show them.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/scene.h>
#include <cstddef>
#include <optional>
#include <vector>

#include "edge_sketch/sketch_input.h"
#include "edge_sketch/view_index.h"
#include "geometry/adjust_edge.h"
#include "geometry/fit_point.h"
#include "poses/adjust_poses.h"
#include "poses/pose_search_estimates.h"

namespace curvix {

// A place on a curve and the 2D edges that show it.
struct CurvePlace {
  OccludingContour contour;
  std::vector<EdgeRef> support;  // at most one per view, ascending
};

struct PlaceSketch {
  std::vector<CurvePlace> places;
  std::size_t min_supports = 0;  // the fewest edges that a place may have
};

class PosedEdges {
 public:
  // The arguments must outlive it.
  PosedEdges(const Scene& scene,
             const std::vector<EdgeMap>& edge_maps,
             const Options& options);
  PosedEdges(const PosedEdges&) = delete;
  PosedEdges& operator=(const PosedEdges&) = delete;

  int num_threads() const { return options_.runtime.num_threads; }

  // With the poses of the scene, each followed by its increment, and the
  // cameras that are set.
  const std::vector<PosedView>& views() const { return views_; }
  const std::vector<PosedView>& input_views() const { return input_views_; }
  const MovedCameras& moved() const { return moved_; }
  MovedCameras Unmoved() const {
    return {std::vector<Rigid3>(views_.size()), scene_.cameras};
  }
  // The number of views whose pose or camera is not that of the scene.
  std::size_t NumMoved() const;
  const Camera& PresentCameraOf(std::size_t view_idx) const;
  // The pose of the scene followed by the view's increment.
  Rigid3 PoseOf(std::size_t view_idx) const;
  void Move(const MovedCameras& moved);

  // Places on curves, from some thousand edges spread over the views. Edges are
  // searched within a few times `sigma_px` of their projections.
  PlaceSketch Sketch(double sigma_px, const StepDone& step_done);

  // The query views of a place, at most forty, ascending: its supporting views
  // (if more than forty, those that differ most in direction), and neighbours
  // of these that add directions.
  std::vector<std::size_t> QueryViews(const CurvePlace& place) const;

  // The nearest edge in each of `views` that is within its gate, by view.
  std::vector<EdgeRef> FindEdges(const OccludingContour& contour,
                                 const std::vector<std::size_t>& views,
                                 const std::vector<double>& gates_px) const;

  // For each view the places that query it; they must outlive the result.
  std::vector<std::vector<const CurvePlace*>> PlacesByView(
      const std::vector<CurvePlace>& places) const;
  // The edges around each place in a view, up to reach_px away.
  std::vector<EdgesAround> LookAround(
      const std::vector<const CurvePlace*>& places,
      std::size_t view_idx,
      double reach_px) const;

  // In the image with the distortion of the input camera.
  ImageEdge DistortedEdge(const EdgeRef& ref) const;
  // Pixels; of the projection of `contour` from the line of the edge.
  double Distance(const OccludingContour& contour, const EdgeRef& ref) const;
  // The pixels of the point, with the present poses and cameras.
  std::vector<PointInImage> Observed(const PointSample& point) const;
  // The pixel of the photograph in which a view sees `x`, in the ideal pinhole
  // of the scene's camera; nothing where there is none.
  std::optional<Eigen::Vector2d> PixelByInputCamera(
      std::size_t view_idx, const Eigen::Vector3d& x) const;
  // Distance of the pixels of `x` in a view with the present cameras and with
  // `before`; nothing where one of the two does not see it.
  std::optional<double> ShiftIn(std::size_t view_idx,
                                const Eigen::Vector3d& x,
                                const MovedCameras& before) const;
  // The contour of the place, adjusted to its support.
  OccludingContour Adjusted(const CurvePlace& place, double sigma_px) const;

 private:
  const Camera& InputCameraOf(std::size_t view_idx) const;
  // `taken` and as many of the `others` as a place needs, each as different in
  // direction from those before as possible, by the poses of the scene.
  // Ascending.
  std::vector<std::size_t> SpreadViews(
      const CurvePlace& place,
      std::vector<std::size_t> taken,
      const std::vector<std::size_t>& others) const;
  ImageEdge InputEdge(const EdgeRef& ref) const;
  // The projection of the contour in the ideal image of the input camera, in
  // which edges are indexed; nothing outside the image.
  std::optional<ImageEdge> Seen(const OccludingContour& contour,
                                std::size_t view_idx) const;
  // The edges in the ideal images of the present cameras; none of a view whose
  // camera cannot be inverted.
  std::vector<EdgeMap> CarriedMaps() const;

  const Scene& scene_;
  const std::vector<EdgeMap>& edge_maps_;
  const Options& options_;
  const std::vector<PosedView> input_views_;
  std::vector<PosedView> views_;  // indices_ points into it
  DistinctViews distinct_;
  std::vector<ViewIndex> indices_;
  double presence_reach_px_ = 0;  // of their presences; 0: none yet
  std::vector<DepthRange> depths_;
  NeighborsByView neighbors_;
  MovedCameras moved_;
};

}  // namespace curvix
