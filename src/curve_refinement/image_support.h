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

// The centres of the views that support a sample.
std::vector<Eigen::Vector3d> SupportingCenters(
    const CurveSample& sample, const std::vector<PosedView>& views);

// The edges of all views, indexed by place. Refers to `views`.
class ImageSupport {
 public:
  // One edge map per view.
  ImageSupport(const std::vector<PosedView>& views,
               const std::vector<EdgeMap>& edge_maps,
               int num_threads);

  // In each view the edge nearest to the projection of an edge in space, if it
  // is at most `max_distance_px` across it and 15 degrees off. Ascending.
  std::vector<EdgeRef> Find(const Eigen::Vector3d& position,
                            const Eigen::Vector3d& tangent,
                            double max_distance_px) const;

  // The edges of a view that run along a projected edge, at most 15 degrees
  // off, and pass it at most `max_distance_px` beside: their signed distances,
  // positive on the side to which (-tangent.y, tangent.x) points.
  std::vector<double> Beside(std::size_t view_idx,
                             const ImageEdge& projected,
                             double max_distance_px) const;

 private:
  const std::vector<PosedView>& views_;
  std::vector<GridIndex> grids_;
};

}  // namespace curvix
