// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/filter_curves.h"

#include <gtest/gtest.h>
#include <cmath>

#include "tests/curve_refinement/drawn_curves.h"

namespace curvix {
namespace {

// The one view has one edge, of this contrast.
constexpr float kContrast = 12;

std::vector<EdgeMap> OneEdge() {
  EdgeMap map;
  map.edges.resize(1);
  map.edges[0].strength = kContrast;
  map.neighbors.resize(1);
  return {map};
}

CurveQualities QualitiesOf(const Curve& curve) {
  return Measure(curve, FrontalViews(), OneEdge());
}

bool Passes(const Curve& curve, const CurveFilterOptions& options) {
  return !FilterCurves({curve}, FrontalViews(), OneEdge(), options).empty();
}

TEST(FilterCurves, MeasuresALine) {
  const CurveQualities line = QualitiesOf(Line(InPlane(0, 0), InPlane(60, 0)));
  EXPECT_NEAR(line.length_px, 60, 1e-9);
  EXPECT_EQ(line.num_views, 1);
  EXPECT_EQ(line.contrast, kContrast);
  EXPECT_NEAR(line.sigma_px, 0.05, 1e-9);
  EXPECT_NEAR(line.straightness, 1, 1e-12);
}

TEST(FilterCurves, CirclesAreTheLessStraightTheSmallerTheyAre) {
  for (const double radius_px : {20.0, 50.0, 100.0}) {
    const CurveQualities circle = QualitiesOf(Arc(radius_px, 0, 3));
    // Tangents of samples one pixel apart are 10 to 11 pixels apart.
    EXPECT_LE(circle.straightness, std::cos(10 / radius_px) + 1e-9);
    EXPECT_GE(circle.straightness, std::cos(11.1 / radius_px));
  }
}

TEST(FilterCurves, KeepsAllByDefault) {
  Curve curve = Line(InPlane(0, 0), InPlane(1, 0));
  for (CurveSample& sample : curve.samples) {
    sample.support.clear();
    sample.sigma = 1;
  }
  EXPECT_TRUE(Passes(curve, {}));
}

TEST(FilterCurves, EachFilterLetsPassWhatJustMeetsIt) {
  const Curve curve = Arc(100, 0, 1);
  const CurveQualities has = QualitiesOf(curve);
  const CurveFilterOptions met = {
      has.length_px, 1, has.contrast, has.sigma_px, has.straightness};
  EXPECT_TRUE(Passes(curve, met));
  CurveFilterOptions missed[5] = {met, met, met, met, met};
  missed[0].min_length_px += 0.01;
  missed[1].min_num_views = 2;
  missed[2].min_contrast += 0.01;
  missed[3].max_sigma_px -= 0.001;
  missed[4].min_straightness += 1e-6;
  for (const CurveFilterOptions& options : missed) {
    EXPECT_FALSE(Passes(curve, options));
  }
}

TEST(FilterCurves, DoesNotDependOnTheUnit) {
  const Curve curve = Arc(50, 0, 2);
  const CurveQualities a = QualitiesOf(curve);
  const CurveQualities b = Measure(
      Scaled({curve}, 1000).front(), Scaled(FrontalViews(), 1000), OneEdge());
  EXPECT_NEAR(a.length_px, b.length_px, 1e-6);
  EXPECT_NEAR(a.sigma_px, b.sigma_px, 1e-9);
  EXPECT_NEAR(a.straightness, b.straightness, 1e-9);
}

}  // namespace
}  // namespace curvix
