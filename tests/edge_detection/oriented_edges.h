// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "edge_detection/third_order_edges.h"

namespace curvix {

// All edges of an image, before any are dropped.
inline std::vector<Edge2d> OrientedEdges(const GrayImage& image,
                                         const EdgeDetectionOptions& options,
                                         double min_gradient) {
  std::vector<Edge2d> edges =
      AcrossGradients(LocateEdges(image, options, min_gradient));
  OrientEdges(image, options, &edges);
  return edges;
}

}  // namespace curvix
