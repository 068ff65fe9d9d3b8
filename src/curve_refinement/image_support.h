// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Which 2D edges of all views a place on a curve has.
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
// MeanSide() of geometry/occluding_contour.h.
Eigen::Vector3d MeanSide(const CurveSample& sample,
                         const std::vector<PosedView>& views);

// The edges of all views, indexed by place. Refers to `views`.
class ImageSupport {
 public:
  // One edge map per view.
  ImageSupport(const std::vector<PosedView>& views,
               const std::vector<EdgeMap>& edge_maps,
               int num_threads);

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

}  // namespace curvix
