// SPDX-License-Identifier: BSD-3-Clause
// Upright bars amid a ring of views.
#include "curve_refinement/occluding_contours.h"

#include <gtest/gtest.h>
#include <vector>

#include "tests/curve_refinement/upright_lines.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

// Bars whose radius is some four pixels. Edges are as noisy as expected.
class ThinBar : public UprightLines {
 public:
  ThinBar() : UprightLines(0.03, 7, kEdgeSigmaPx) {}

  // Of an upright curve.
  CurveKind KindAt(const Vector3d& foot, double scale = 1) const {
    std::vector<Curve> curves = Scaled({CurveAt(foot)}, scale);
    LabelRoundBars(
        Scaled(views(), scale), edge_maps(), kEdgeSigmaPx, 1, &curves);
    return curves[0].samples[20].kind;
  }
};

TEST(LabelRoundBars, SeesBothSidesOfARoundBar) {
  ThinBar scene;
  scene.DrawCylinder();
  for (const double scale : {1.0, 1000.0}) {
    EXPECT_EQ(scene.KindAt(scene.Side(), scale), CurveKind::kOccludingContour);
    EXPECT_EQ(scene.KindAt(-scene.Side(), scale), CurveKind::kOccludingContour);
  }
}

TEST(LabelRoundBars, LeavesAFlatBar) {
  ThinBar scene;
  for (const double side : {1.0, -1.0}) {
    scene.DrawInAllViews(side * scene.Side());
  }
  EXPECT_EQ(scene.KindAt(scene.Side()), CurveKind::kUnknown);
}

TEST(LabelRoundBars, LeavesASquareBar) {
  ThinBar scene;
  const Vector3d right = scene.Side();
  const Vector3d back = ThinBar::Up().cross(right);
  for (const double side : {1.0, -1.0}) {
    scene.DrawInAllViews(side * right + back);
    scene.DrawInAllViews(side * right - back);
  }
  EXPECT_EQ(scene.KindAt(right + back), CurveKind::kUnknown);
  EXPECT_EQ(scene.KindAt(right - back), CurveKind::kUnknown);
}

TEST(LabelRoundBars, LeavesAnEdgeThatStandsAlone) {
  ThinBar scene;
  scene.DrawInAllViews(scene.Side());
  EXPECT_EQ(scene.KindAt(scene.Side()), CurveKind::kUnknown);
}

}  // namespace
}  // namespace curvix
