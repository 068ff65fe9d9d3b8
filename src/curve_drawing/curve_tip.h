// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The end of a growing curve.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/adjust_edge.h"
#include "geometry/directions.h"
#include "geometry/edge_geometry.h"
#include "model/posed_view.h"

namespace curvix {

// Place and direction of the end of a curve, and how well they are known: a
// Kalman filter along the curve. The state is the offset across the tangent, in
// pixels, and the slope of the tangent, both along two axes. Each 2D edge
// measures the offset across its plane and the slope out of it. The direction
// wanders from pixel to pixel as a random walk. The axes may be left-handed.
class CurveTip {
 public:
  // `pixel`: of world units; `measurements`: those that gave `edge`.
  CurveTip(const SpaceEdge& edge,
           const std::vector<PlaneMeasurement>& measurements,
           double sigma_px,
           double pixel);

  const SpaceEdge& edge() const { return edge_; }
  double pixel() const { return pixel_; }

  // Turns the tip round.
  void Reverse();
  // Predicts the tip that much further along.
  void Step(double step_px);
  // Moves and turns the tip to where these 2D edges show it, with Cauchy's
  // weights. Their order makes no difference.
  void Correct(const std::vector<PlaneMeasurement>& measurements);

  // Of the distance across the tangent from where the true curve is seen, px^2.
  double VarianceIn(const PosedView& view, const ImageEdge& projected) const;

  // Standard deviation of the place across the curve, of each axis, world.
  double Sigma() const;

 private:
  void FoldIn(const Eigen::Vector4d& change);

  SpaceEdge edge_;
  AcrossAxes axes_;
  Eigen::Matrix4d covariance_ = Eigen::Matrix4d::Zero();
  double sigma_px_;
  double pixel_;
};

}  // namespace curvix
