// SPDX-License-Identifier: BSD-3-Clause
// Upright lines amid a ring of views, for tests of what turns away from them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/curve_refinement/drawn_curves.h"
#include "tests/support/random.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {

// What twenty-four views see of upright lines, and of an upright cylinder about
// the origin. Edges have `noise_px`.
class UprightLines {
 public:
  // The first views, `num_supporting`, agree on curves.
  UprightLines(double radius, std::int32_t num_supporting, double noise_px)
      : radius_(radius), num_supporting_(num_supporting), noise_px_(noise_px) {}

  // Draws a line through `foot` into a view.
  void Draw(std::size_t view_idx, const Eigen::Vector3d& foot) {
    for (int k = -100; k <= 100; ++k) {
      const auto projected =
          ProjectEdge(views_[view_idx], {foot + 0.004 * k * Up(), Up()});
      const Eigen::Vector2d noise =
          noise_px_ * Eigen::Vector2d(random_.Normal(), random_.Normal());
      edge_maps_[view_idx].edges.push_back(
          {projected->position + noise,
           static_cast<float>(
               std::atan2(projected->tangent.y(), projected->tangent.x())),
           10});
    }
  }
  void DrawInAllViews(const Eigen::Vector3d& foot) {
    for (std::size_t v = 0; v < views_.size(); ++v) Draw(v, foot);
  }
  // The contours of the cylinder.
  void DrawCylinder() {
    for (std::size_t v = 0; v < views_.size(); ++v) {
      for (const double side : {1.0, -1.0}) Draw(v, side * Side(v));
    }
  }

  static Eigen::Vector3d Up() { return Eigen::Vector3d::UnitZ(); }
  // From the axis to the right side of the cylinder, as a view sees it.
  Eigen::Vector3d Side(std::size_t view_idx) const {
    return radius_ * Up().cross(views_[view_idx].center).normalized();
  }
  // As the views that support curves see it, on the whole.
  Eigen::Vector3d Side() const {
    return Side(static_cast<std::size_t>(num_supporting_ / 2));
  }
  // An upright curve that the first views support.
  Curve CurveAt(const Eigen::Vector3d& foot) const {
    Curve curve;
    for (int k = -20; k <= 20; ++k) {
      CurveSample& sample = curve.samples.emplace_back();
      sample.position = foot + 0.01 * k * Up();
      sample.tangent = Up();
      for (std::int32_t v = 0; v < num_supporting_; ++v) {
        sample.support.push_back({v, 0});
      }
    }
    return curve;
  }
  const std::vector<PosedView>& views() const { return views_; }
  const std::vector<EdgeMap>& edge_maps() const { return edge_maps_; }

 private:
  double radius_;
  std::int32_t num_supporting_;
  double noise_px_;
  Random random_{3};
  std::vector<PosedView> views_ = RingOfViews(24);
  std::vector<EdgeMap> edge_maps_{24};
};

}  // namespace curvix
