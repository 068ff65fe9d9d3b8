// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The edges of views whose poses change, and samples
// of the curves that they show.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/scene.h>

#include <cstddef>
#include <vector>

#include "geometry/rim.h"
#include "pipeline/sketch_internal.h"
#include "pipeline/view_indices.h"
#include "poses/adjust_poses.h"
#include "poses/find_shift.h"

namespace curvix {

// More than an edge of a curve needs, since places are many.
inline constexpr std::size_t kMinSupportsOfPlace = 6;

// A place on a curve and the 2D edges that show it.
struct CurvePlace {
  Rim rim;
  std::vector<EdgeRef> support;  // at most one per view, ascending
};

class PosedEdges {
 public:
  // The arguments must outlive it.
  PosedEdges(const Scene& scene,
             const std::vector<EdgeMap>& edge_maps,
             const Options& options);
  PosedEdges(const PosedEdges&) = delete;
  PosedEdges& operator=(const PosedEdges&) = delete;

  // With the poses of the scene, each followed by its motion.
  const std::vector<PosedView>& views() const { return views_; }
  const std::vector<PosedView>& input_views() const { return input_views_; }
  const std::vector<Rigid3>& motions() const { return motions_; }
  void SetMotions(std::vector<Rigid3> new_cam_from_cam);

  // Places on curves, from some thousand edges spread over the views. Edges
  // are expected within a few times `sigma_px` of where the poses put them.
  std::vector<CurvePlace> Sketch(double sigma_px,
                                 const StepDone& step_done) const;

  // The views to ask about a place: its supporters and the views next to them.
  std::vector<std::size_t> ViewsToAsk(const CurvePlace& place) const;

  // The nearest edge in each of `views` that is within its gate, by view.
  std::vector<EdgeRef> FindEdges(const Rim& rim,
                                 const std::vector<std::size_t>& views,
                                 const std::vector<double>& gates_px) const;

  // For each view the places that ask it; they outlive the result.
  std::vector<std::vector<const CurvePlace*>> PlacesByView(
      const std::vector<CurvePlace>& places) const;
  // What the places see around them in a view, up to reach_px away.
  std::vector<EdgesAround> LookAround(
      const std::vector<const CurvePlace*>& places,
      std::size_t view_idx,
      double reach_px) const;

  ImageEdge EdgeOf(const EdgeRef& ref) const;
  // Pixels; of the projection of `rim` from the line of the edge.
  double Distance(const Rim& rim, const EdgeRef& ref) const;
  // Pixels that the supported places have moved by, from the poses of the
  // scene, in each view.
  std::vector<std::vector<double>> ShiftsByView(
      const std::vector<CurvePlace>& places) const;
  // The rim of the place, adjusted to its support.
  Rim Adjusted(const CurvePlace& place, double sigma_px) const;

 private:
  const Scene& scene_;
  const std::vector<EdgeMap>& edge_maps_;
  const Options& options_;
  const std::vector<PosedView> input_views_;
  std::vector<PosedView> views_;  // indices_ points into it
  std::vector<ViewIndex> indices_;
  std::vector<std::vector<ViewOverlap>> overlaps_;
  std::vector<DepthRange> depths_;
  std::vector<std::vector<ViewNeighbor>> neighbors_;
  std::vector<Rigid3> motions_;
};

}  // namespace curvix
