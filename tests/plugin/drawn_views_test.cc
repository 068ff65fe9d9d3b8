// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/draw/drawn_views.h"

#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "base/angles.h"

namespace curvix {
namespace {

CurveFit LineIn(double x0, double z0, double x1, double z1) {
  CurveFit line;
  line.start = {x0, 0, z0};
  line.end = {x1, 0, z1};
  return line;
}

// A wheel, which makes the edge of the front, and a line far away.
CurvesFile WheelAndLineFarAway() {
  CurveFit wheel;
  wheel.kind = FitKind::kArc;
  wheel.closed = true;
  wheel.center = {0, 0, 0};
  wheel.major = {0.6, 0, 0.8};
  wheel.minor = {-0.8, 0, 0.6};
  wheel.end_angle = 2 * kPi;
  wheel.start = wheel.end = wheel.center + wheel.major;
  CurvesFile curves;
  curves.fitted.curves = {
      {{wheel}}, {{LineIn(-0.5, 0, 0.5, 0)}}, {{LineIn(90, 0, 90.1, 0)}}};
  return curves;
}

TEST(DrawnViews, LeaveOutWhatIsFarAndKeepTheRestWhole) {
  const CurvesFile curves = WheelAndLineFarAway();
  const Scene scene;
  std::vector<DrawnView> views = {{*AxisPlane("xz")}, {*AxisPlane("xy")}};
  FillViews({curves, scene, "solid", true, true}, &views);
  for (const DrawnView& view : views) {
    EXPECT_EQ(view.num_far, 1u);
    EXPECT_EQ(view.curves.size(), 2u);
  }
  EXPECT_TRUE(views[0].curves[0].fit.closed);
  EXPECT_NEAR(BoundsOf(views[0].curves).sizes().x(), 2, 0.01);
  EXPECT_NEAR(BoundsOf(views[1].curves).sizes().x(), 2, 0.01);
  // The plan is above the front, with room for dimensions between.
  EXPECT_GT(BoundsOf(views[1].curves).min().y(),
            BoundsOf(views[0].curves).max().y() + 0.3 * 2);
}

// Third-angle projection: a view lies on the side from which it is seen.
TEST(DrawnViews, LieOnTheSideFromWhichTheyAreSeen) {
  const CurvesFile curves = WheelAndLineFarAway();
  const Scene scene;
  const auto bounds_of = [&](std::vector<DrawnView> views) {
    FillViews({curves, scene, "solid", false, true}, &views);
    return std::pair(BoundsOf(views[0].curves), BoundsOf(views[1].curves));
  };
  const DrawingPlane xz = *AxisPlane("xz");
  const DrawingPlane xy = *AxisPlane("xy");
  const DrawingPlane yz = *AxisPlane("yz");
  const auto [plan, front] = bounds_of({{xy}, {xz}});
  EXPECT_LT(front.max().y(), plan.min().y());
  const auto [back, from_below] =
      bounds_of({{FromBehind(xz)}, {FromBehind(xy)}});
  EXPECT_LT(from_below.max().y(), back.min().y());
  const auto [first, side] = bounds_of({{xz}, {yz}});
  EXPECT_GT(side.min().x(), first.max().x());
  const auto [second, its_front] = bounds_of({{yz}, {xz}});
  EXPECT_LT(its_front.max().x(), second.min().x());
}

TEST(DrawnViews, HaveEverythingOnRequest) {
  const CurvesFile curves = WheelAndLineFarAway();
  const Scene scene;
  std::vector<DrawnView> views = {{*AxisPlane("xz")}};
  FillViews({curves, scene, "solid", true, false}, &views);
  EXPECT_EQ(views[0].num_far, 0u);
  EXPECT_EQ(views[0].curves.size(), 3u);
}

}  // namespace
}  // namespace curvix
