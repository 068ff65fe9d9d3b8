// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Which 2D edges of all views a place on a curve has,
// and how likely those beside it are if a view shows a contour there.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "base/grid_index.h"
#include "geometry/edge_geometry.h"
#include "model/posed_view.h"

namespace curvix {

// The mean side from which the views that support a sample see it; see
// MeanSide() of geometry/adjust_edge.h.
Eigen::Vector3d MeanSide(const CurveSample& sample,
                         const std::vector<PosedView>& views);

// The edges of all views, indexed by place. Refers to `views`.
class ImageSupport {
 public:
  // One edge map per view.
  ImageSupport(const std::vector<PosedView>& views,
               const std::vector<EdgeMap>& edge_maps,
               int num_threads);

  const std::vector<PosedView>& views() const { return views_; }

  // In each view the edge nearest to the projection of `edge` inside the gate
  // of an edge that a view shows (geometry/nearest_edge.h). Ascending.
  std::vector<EdgeRef> Find(const SpaceEdge& edge) const;

  // The edges of a view that run along a projected edge, at most 15 degrees
  // off, and pass it at most `max_distance_px` beside: their signed distances,
  // positive on the side to which (-tangent.y, tangent.x) points; ascending.
  std::vector<double> Beside(std::size_t view_idx,
                             const ImageEdge& projected,
                             double max_distance_px) const;

 private:
  const std::vector<PosedView>& views_;
  std::vector<GridIndex> grids_;
};

// Along a curve, from one place at which its contours are compared to the next.
constexpr double kPlaceSpacingPx = 15;

// From a contour `at_px` beside the curve to the nearest of `edges_px`, signed
// distances from the curve, ascending; infinite without any.
double NearestResidual(const std::vector<double>& edges_px, double at_px);

// Of an edge this far from where a contour is expected, over that of other
// edges, of which there are `density` per pixel; 0 if the residual is infinite.
double LogLikelihoodOfContour(double residual_px,
                              double sigma_px,
                              double density);

// Contours per pixel across the curve, from the number of edges found at most
// `reach_px` beside it in all views.
double DensityOfContours(double num_edges, double num_views, double reach_px);

}  // namespace curvix
