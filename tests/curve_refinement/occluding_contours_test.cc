// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/occluding_contours.h"

#include <gtest/gtest.h>
#include <cstdint>
#include <vector>

#include "geometry/adjust_edge.h"
#include "tests/curve_refinement/upright_lines.h"

namespace curvix {
namespace {

constexpr std::int32_t kNumSupporting = 3;

// A cylinder whose radius is some forty pixels.
class ThickCylinder : public UprightLines {
 public:
  ThickCylinder() : UprightLines(0.3, kNumSupporting, 0) {}

  // Of an upright curve.
  double Ratio(const Eigen::Vector3d& foot, double scale = 1) const {
    return Ratio(CurveAt(foot), scale);
  }
  double Ratio(const Curve& curve, double scale = 1) const {
    const std::vector<PosedView> scaled = Scaled(views(), scale);
    const ImageSupport images(scaled, edge_maps(), 1);
    return ContourLogLikelihoodRatio(
        Scaled({curve}, scale).front(), images, kEdgeSigmaPx);
  }
};

TEST(ContourLogLikelihoodRatio, SeesThatACylinderTurnsAway) {
  ThickCylinder scene;
  scene.DrawCylinder();
  EXPECT_GT(scene.Ratio(scene.Side()), 4);
}

TEST(ContourLogLikelihoodRatio, IsZeroOfAnEdgeThatStandsAlone) {
  ThickCylinder scene;
  scene.DrawInAllViews(scene.Side());
  EXPECT_EQ(scene.Ratio(scene.Side()), 0);
}

TEST(ContourLogLikelihoodRatio, TakesNoParallelEdgeForAContour) {
  for (double distance : {0.02, 0.05}) {
    for (const Eigen::Vector3d& direction :
         {Eigen::Vector3d::UnitX().eval(), Eigen::Vector3d::UnitY().eval()}) {
      ThickCylinder scene;
      const Eigen::Vector3d foot = scene.Side();
      for (std::size_t v = 0; v < kNumSupporting; ++v) scene.Draw(v, foot);
      scene.DrawInAllViews(foot + distance * direction);
      EXPECT_LT(scene.Ratio(foot), 1) << distance << ", " << direction;
    }
  }
}

TEST(ContourLogLikelihoodRatio, LooksAtSamplesWithSupportOnly) {
  ThickCylinder scene;
  scene.DrawCylinder();
  const Curve curve = scene.CurveAt(scene.Side());
  Curve carried_on = curve;
  for (int k = 1; k <= 40; ++k) {  // 50 pixels further, where no edge is
    CurveSample& sample = carried_on.samples.emplace_back(curve.samples.back());
    sample.position += (0.4 + 0.01 * k) * ThickCylinder::Up();
    sample.support.clear();
  }
  EXPECT_GT(scene.Ratio(curve), 4);
  EXPECT_EQ(scene.Ratio(carried_on), scene.Ratio(curve));
  for (CurveSample& sample : carried_on.samples) sample.support.clear();
  EXPECT_EQ(scene.Ratio(carried_on), 0);
}

TEST(ContourLogLikelihoodRatio, DoesNotDependOnTheUnit) {
  ThickCylinder scene;
  scene.DrawCylinder();
  const Eigen::Vector3d foot = scene.Side();
  EXPECT_NEAR(scene.Ratio(foot, 1000), scene.Ratio(foot), 1e-6);
}

}  // namespace
}  // namespace curvix
