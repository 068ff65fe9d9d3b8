// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. Sub-pixel edges with third-order orientation.
#pragma once

#include <curvix/edges.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "base/gray_image.h"
#include "edge_detection/gradient_rows.h"

namespace curvix {

// An edge as it is located, before it has an orientation.
struct LocatedEdge {
  // Pixels. Not aligned, for there may be millions: 32 bytes each.
  Eigen::Matrix<double, 2, 1, Eigen::DontAlign> position;
  Eigen::Vector2f gradient;  // of the nearest grid point, grey levels per pixel
  float crowding = 0;        // Edge2d::crowding

  float strength() const {
    return std::sqrt(gradient.x() * gradient.x() + gradient.y() * gradient.y());
  }
};

// The places of the edges of `image`, in its own (possibly distorted) pixels,
// row by row on the grid of `scale`. Steps:
//  1. Gaussian derivatives on the grid; gradient magnitude; points at or below
//     `min_gradient` (grey levels per pixel) are dropped.
//  2. Non-maximum suppression along the gradient with a parabola through three
//     values interpolated between grid neighbours: position. Edges nearer than
//     4 px to the border are dropped.
// Images below 2 x 2 pixels have no edges.
std::vector<LocatedEdge> LocateEdges(const GrayImage& image,
                                     const DetectionScale& scale,
                                     double min_gradient);

// The same edges with their strengths, and at right angles to their gradients;
// the rest is up to OrientEdges().
std::vector<Edge2d> AcrossGradients(const std::vector<LocatedEdge>& edges);

// Gives edges of `image` from AcrossGradients() their orientation: the
// tangent of the curve F = g^T H g = 0 (g gradient, H Hessian) at their
// position, from derivatives up to the third order. Strength and sharpness are
// those at the position, too. If `refine`, then moves them along the gradient
// to where its magnitude peaks, by a step of Newton's method of at most 0.3 px:
// the parabola of LocateEdges() is some hundredths of a pixel off. Otherwise
// filters reach as far as those of the published detector.
void OrientEdges(const GrayImage& image,
                 double sigma_px,
                 bool refine,
                 std::vector<Edge2d>* edges);

}  // namespace curvix
