// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/filter_curves.h"

#include <gtest/gtest.h>
#include <cmath>
#include <numbers>

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

TEST(FilterCurves, RingsThatTurnBackAreNotStraight) {
  // Half the circumference is 10 pixels.
  const double radius_px = 10 / std::numbers::pi;
  const CurveQualities ring =
      QualitiesOf(Arc(radius_px, 0, 2 * std::numbers::pi));
  EXPECT_EQ(ring.straightness, 0);
}

TEST(FilterCurves, KeepsAllByDefault) {
  Curve curve = Line(InPlane(0, 0), InPlane(1, 0));
  for (CurveSample& sample : curve.samples) {
    sample.support.clear();
    sample.sigma = 1;
  }
  EXPECT_TRUE(Passes(curve, {}));
  EXPECT_TRUE(Passes(Arc(3, 0, 2 * std::numbers::pi), {}));
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

TEST(FilterCurves, CutsOtherKindsOutAndKeepsWhatIsUnknown) {
  Curve curve = Line(InPlane(0, 0), InPlane(60, 0));
  const std::size_t size = curve.samples.size();
  ASSERT_GT(size, 40u);
  for (std::size_t i = 0; i < size; ++i) {
    curve.samples[i].kind = i < 10   ? CurveKind::kCrease
                            : i < 20 ? CurveKind::kMarking
                                     : CurveKind::kUnknown;
  }
  CurveFilterOptions options;
  options.kinds = CurveKindSet::None();
  options.kinds.Add(CurveKind::kCrease);
  const std::vector<Curve> kept =
      FilterCurves({curve}, FrontalViews(), OneEdge(), options);
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[0].samples.size(), 10u);
  EXPECT_EQ(kept[1].samples.size(), size - 20);
  EXPECT_EQ(kept[1].samples[0].position, curve.samples[20].position);

  // A closed curve begins behind what is cut out.
  curve.closed = true;
  const std::vector<Curve> opened =
      FilterCurves({curve}, FrontalViews(), OneEdge(), options);
  ASSERT_EQ(opened.size(), 1u);
  EXPECT_FALSE(opened[0].closed);
  EXPECT_EQ(opened[0].samples.size(), size - 10);
  EXPECT_EQ(opened[0].samples[0].position, curve.samples[20].position);
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
