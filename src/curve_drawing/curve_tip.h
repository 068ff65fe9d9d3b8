// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The end of a growing curve, and which views support
// it steadily.
#pragma once

#include <curvix/edges.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "geometry/adjust_edge.h"
#include "geometry/directions.h"
#include "geometry/edge_geometry.h"
#include "model/posed_view.h"

namespace curvix {

// Position and direction of the end of a curve with their covariance: a Kalman
// filter along the curve. The state is the offset across the tangent, in
// pixels, and the slope of the tangent, each along two axes. Each 2D edge
// measures the offset from its plane and the slope out of it. The direction is
// a random walk from pixel to pixel. The axes may be left-handed.
class CurveTip {
 public:
  // `pixel`: of world units; `measurements`: those that gave `edge`. Where they
  // hardly tell its direction, the tip is across the rays.
  CurveTip(const SpaceEdge& edge,
           const std::vector<PlaneMeasurement>& measurements,
           double sigma_px,
           double pixel);

  const SpaceEdge& edge() const { return edge_; }
  double pixel() const { return pixel_; }

  // Reverses the direction.
  void Reverse();
  // Predicts the tip after a step along the tangent.
  void Step(double step_px);
  // Corrects the tip by these 2D edges, with Cauchy's weights. Their order
  // makes a difference by rounding.
  void Correct(const std::vector<PlaneMeasurement>& measurements);

  // Variance of the distance across the projected tangent, px^2.
  double VarianceIn(const PosedView& view, const ImageEdge& projected) const;

  // Standard deviation across the curve, along each axis, world units.
  double Sigma() const;

 private:
  void FoldIn(const Eigen::Vector4d& change);

  SpaceEdge edge_;
  AcrossAxes axes_;
  Eigen::Matrix4d covariance_ = Eigen::Matrix4d::Zero();
  double sigma_px_;
  double pixel_;
};

// The views that supported the last samples of a curve.
class Streaks {
 public:
  // Hits and misses in a row that count.
  static constexpr int kLength = 3;

  // Those of the seed's support are trusted from the start, the others after
  // three hits in a row; three misses in a row end it.
  Streaks(std::size_t num_views, const std::vector<EdgeRef>& seed_support)
      : streaks_(num_views) {
    for (const EdgeRef& ref : seed_support) {
      streaks_[static_cast<std::size_t>(ref.view_idx)].is_trusted = true;
    }
  }

  // Adds the view's result for the next sample. Whether it is a hit of a
  // trusted view.
  bool Count(std::size_t view_idx, bool is_hit) {
    Streak& streak = streaks_[view_idx];
    streak.length = streak.is_of_hits == is_hit ? streak.length + 1 : 1;
    streak.is_of_hits = is_hit;
    if (streak.length >= kLength) streak.is_trusted = is_hit;
    return is_hit && streak.is_trusted;
  }

 private:
  struct Streak {
    bool is_of_hits = false;
    int length = 0;
    bool is_trusted = false;
  };
  std::vector<Streak> streaks_;
};

}  // namespace curvix
