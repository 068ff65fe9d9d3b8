// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "edge_detection/third_order_edges.h"

namespace curvix {

// All edges of an image, before any are dropped.
inline std::vector<Edge2d> OrientedEdges(const GrayImage& image,
                                         const DetectionScale& scale,
                                         double min_gradient) {
  std::vector<Edge2d> edges =
      AcrossGradients(LocateEdges(image, scale, min_gradient));
  OrientEdges(image, scale.sigma_px, /*refine=*/true, &edges);
  return edges;
}

// Those at least `border_px` from the border of the image.
inline std::vector<Edge2d> WithoutBorder(std::vector<Edge2d> edges,
                                         const GrayImage& image,
                                         double border_px) {
  std::erase_if(edges, [&](const Edge2d& edge) {
    const Eigen::Vector2d& p = edge.position;
    return p.minCoeff() < border_px || p.x() > image.width - border_px ||
           p.y() > image.height - border_px;
  });
  return edges;
}

}  // namespace curvix
