// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/occluding_contours.h"

#include <gtest/gtest.h>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/occluding_contour.h"
#include "tests/curve_refinement/drawn_curves.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

constexpr double kSigmaPx = 0.15;
constexpr double kRadius = 0.3;  // some forty pixels
// The views that agree on a curve.
constexpr std::int32_t kNumSupporting = 3;

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

// Twenty-four views around upright curves.
class Scene {
 public:
  // Draws an upright line through `foot` into a view.
  void Draw(std::size_t view_idx, const Eigen::Vector3d& foot) {
    for (int k = -100; k <= 100; ++k) {
      const auto projected =
          ProjectEdge(views_[view_idx], {foot + 0.004 * k * kUp, kUp});
      edge_maps_[view_idx].edges.push_back(
          {projected->position,
           static_cast<float>(
               std::atan2(projected->tangent.y(), projected->tangent.x())),
           10});
    }
  }
  void DrawInAllViews(const Eigen::Vector3d& foot) {
    for (std::size_t v = 0; v < views_.size(); ++v) Draw(v, foot);
  }
  // The contours of an upright cylinder about the origin.
  void DrawCylinder() {
    for (std::size_t v = 0; v < views_.size(); ++v) {
      for (double side : {1.0, -1.0}) {
        Draw(v, side * kRadius * SideSeen(v));
      }
    }
  }
  // Across the axis and the ray, on the right.
  Eigen::Vector3d SideSeen(std::size_t view_idx) const {
    return kUp.cross(views_[view_idx].center).normalized();
  }
  // An upright curve that the first views support.
  double Ratio(const Eigen::Vector3d& foot, double scale = 1) const {
    Curve curve;
    for (int k = -20; k <= 20; ++k) {
      CurveSample& sample = curve.samples.emplace_back();
      sample.position = foot + 0.01 * k * kUp;
      sample.tangent = kUp;
      for (std::int32_t v = 0; v < kNumSupporting; ++v) {
        sample.support.push_back({v, 0});
      }
    }
    const std::vector<PosedView> views = Scaled(views_, scale);
    const ImageSupport images(views, edge_maps_, 1);
    return ContourLogLikelihoodRatio(
        Scaled({curve}, scale).front(), views, images, kSigmaPx);
  }

 private:
  std::vector<PosedView> views_ = RingOfViews(24);
  std::vector<EdgeMap> edge_maps_{24};
};

// Where the views that support the curve see the cylinder end, on the whole.
Eigen::Vector3d MiddleOfContour(const Scene& scene) {
  return kRadius * scene.SideSeen(kNumSupporting / 2);
}

TEST(ContourLogLikelihoodRatio, SeesThatACylinderTurnsAway) {
  Scene scene;
  scene.DrawCylinder();
  EXPECT_GT(scene.Ratio(MiddleOfContour(scene)), 4);
}

TEST(ContourLogLikelihoodRatio, IsZeroOfAnEdgeThatStandsAlone) {
  Scene scene;
  scene.DrawInAllViews(MiddleOfContour(scene));
  EXPECT_EQ(scene.Ratio(MiddleOfContour(scene)), 0);
}

TEST(ContourLogLikelihoodRatio, TakesNoParallelEdgeForAContour) {
  for (double distance : {0.02, 0.05}) {
    for (const Eigen::Vector3d& direction :
         {Eigen::Vector3d::UnitX().eval(), Eigen::Vector3d::UnitY().eval()}) {
      Scene scene;
      const Eigen::Vector3d foot = MiddleOfContour(scene);
      for (std::size_t v = 0; v < kNumSupporting; ++v) scene.Draw(v, foot);
      scene.DrawInAllViews(foot + distance * direction);
      EXPECT_LT(scene.Ratio(foot), 1) << distance << ", " << direction;
    }
  }
}

TEST(ContourLogLikelihoodRatio, DoesNotDependOnTheUnit) {
  Scene scene;
  scene.DrawCylinder();
  const Eigen::Vector3d foot = MiddleOfContour(scene);
  EXPECT_NEAR(scene.Ratio(foot, 1000), scene.Ratio(foot), 1e-6);
}

}  // namespace
}  // namespace curvix
