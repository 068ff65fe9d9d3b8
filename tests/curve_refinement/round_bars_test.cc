// SPDX-License-Identifier: BSD-3-Clause
// Upright bars amid a ring of views.
#include "curve_refinement/round_bars.h"

#include <gtest/gtest.h>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/curve_refinement/drawn_curves.h"
#include "tests/support/random.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

constexpr double kSigmaPx = 0.15;
constexpr double kRadius = 0.03;  // some four pixels
// The views that agree on a curve.
constexpr std::int32_t kNumSupporting = 7;

const Vector3d kUp = Vector3d::UnitZ();

class Scene {
 public:
  // Draws an upright line through `foot` into a view, with noise.
  void Draw(std::size_t view_idx, const Vector3d& foot) {
    for (int k = -100; k <= 100; ++k) {
      const auto projected =
          ProjectEdge(views_[view_idx], {foot + 0.004 * k * kUp, kUp});
      const Eigen::Vector2d noise =
          kSigmaPx * Eigen::Vector2d(random_.Normal(), random_.Normal());
      edge_maps_[view_idx].edges.push_back(
          {projected->position + noise,
           static_cast<float>(
               std::atan2(projected->tangent.y(), projected->tangent.x())),
           10});
    }
  }
  void DrawInAllViews(const Vector3d& foot) {
    for (std::size_t v = 0; v < views_.size(); ++v) Draw(v, foot);
  }
  void DrawRoundBar() {
    for (std::size_t v = 0; v < views_.size(); ++v) {
      for (const double side : {1.0, -1.0}) Draw(v, side * Side(v));
    }
  }
  // From the axis to the right side, as a view sees it.
  Vector3d Side(std::size_t view_idx) const {
    return kRadius * kUp.cross(views_[view_idx].center).normalized();
  }
  // As the views that support curves see it.
  Vector3d Side() const { return Side(kNumSupporting / 2); }
  // Of an upright curve.
  CurveKind KindAt(const Vector3d& foot, double scale = 1) const {
    Curve curve;
    for (int k = -20; k <= 20; ++k) {
      CurveSample& sample = curve.samples.emplace_back();
      sample.position = foot + 0.01 * k * kUp;
      sample.tangent = kUp;
      for (std::int32_t v = 0; v < kNumSupporting; ++v) {
        sample.support.push_back({v, 0});
      }
    }
    std::vector<Curve> curves = {Scaled({curve}, scale).front()};
    LabelRoundBars(Scaled(views_, scale), edge_maps_, kSigmaPx, 1, &curves);
    return curves[0].samples[20].kind;
  }

 private:
  Random random_{3};
  std::vector<PosedView> views_ = RingOfViews(24);
  std::vector<EdgeMap> edge_maps_{24};
};

TEST(LabelRoundBars, SeesBothSidesOfARoundBar) {
  Scene scene;
  scene.DrawRoundBar();
  for (const double scale : {1.0, 1000.0}) {
    EXPECT_EQ(scene.KindAt(scene.Side(), scale), CurveKind::kOccludingContour);
    EXPECT_EQ(scene.KindAt(-scene.Side(), scale), CurveKind::kOccludingContour);
  }
}

TEST(LabelRoundBars, LeavesAFlatBar) {
  Scene scene;
  for (const double side : {1.0, -1.0}) {
    scene.DrawInAllViews(side * scene.Side());
  }
  EXPECT_EQ(scene.KindAt(scene.Side()), CurveKind::kUnknown);
}

TEST(LabelRoundBars, LeavesASquareBar) {
  Scene scene;
  const Vector3d right = scene.Side();
  const Vector3d back = kUp.cross(right);
  for (const double side : {1.0, -1.0}) {
    scene.DrawInAllViews(side * right + back);
    scene.DrawInAllViews(side * right - back);
  }
  EXPECT_EQ(scene.KindAt(right + back), CurveKind::kUnknown);
  EXPECT_EQ(scene.KindAt(right - back), CurveKind::kUnknown);
}

TEST(LabelRoundBars, LeavesAnEdgeThatStandsAlone) {
  Scene scene;
  scene.DrawInAllViews(scene.Side());
  EXPECT_EQ(scene.KindAt(scene.Side()), CurveKind::kUnknown);
}

}  // namespace
}  // namespace curvix
