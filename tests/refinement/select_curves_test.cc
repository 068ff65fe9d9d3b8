// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/select_curves.h"

#include <gtest/gtest.h>

#include "tests/refinement/drawn_curves.h"

namespace curvix {
namespace {

constexpr CurveRefinementOptions kOptions = {.min_evidence = 20,
                                             .sigma_scale_px = 0.12};

Curve CurveWith(double evidence, double sigma_px) {
  Curve curve = Line(InPlane(0, 0), InPlane(20, 0));
  for (CurveSample& sample : curve.samples) {
    sample.evidence = evidence;
    sample.sigma = sigma_px * kPixel;
  }
  return curve;
}

bool IsSelected(const Curve& curve) {
  return !SelectCurves({curve}, FrontalViews(), kOptions).empty();
}

TEST(SelectCurves, AsksForEvidence) {
  EXPECT_TRUE(IsSelected(CurveWith(20, 0.05)));
  EXPECT_FALSE(IsSelected(CurveWith(19.999, 0.05)));
}

TEST(SelectCurves, AsksForMoreWherePositionsAreLessSure) {
  for (const double ratio : {1.0, 1.5, 3.0}) {
    const double needed = 20 * ratio * ratio;
    EXPECT_TRUE(IsSelected(CurveWith(needed + 1e-6, ratio * 0.12)));
    EXPECT_FALSE(IsSelected(CurveWith(needed - 1e-6, ratio * 0.12)));
  }
}

TEST(SelectCurves, JudgesByTheMedian) {
  Curve curve = CurveWith(25, 0.05);
  for (std::size_t k = 0; k < 10; ++k) curve.samples[k].evidence = 1;
  EXPECT_TRUE(IsSelected(curve));  // 11 of 21 are confirmed
  curve.samples[10].evidence = 1;
  EXPECT_FALSE(IsSelected(curve));
}

TEST(SelectCurves, KeepsCurvesOfUnknownSigma) {
  EXPECT_TRUE(IsSelected(CurveWith(0, 0)));
}

TEST(SelectCurves, KeepsTheOrder) {
  std::vector<Curve> curves;
  for (const double evidence : {30, 5, 40, 50, 6}) {
    curves.push_back(CurveWith(evidence, 0.05));
  }
  std::vector<double> selected;
  for (const Curve& curve : SelectCurves(curves, FrontalViews(), kOptions)) {
    selected.push_back(curve.samples.front().evidence);
  }
  EXPECT_EQ(selected, (std::vector<double>{30, 40, 50}));
}

TEST(SelectCurves, DoesNotDependOnTheUnit) {
  for (const double evidence : {44.9, 45.1}) {  // 20 * 1.5^2
    const std::vector<Curve> curves = {CurveWith(evidence, 0.18)};
    EXPECT_EQ(SelectCurves(
                  Scaled(curves, 1000), Scaled(FrontalViews(), 1000), kOptions)
                  .size(),
              SelectCurves(curves, FrontalViews(), kOptions).size());
  }
}

}  // namespace
}  // namespace curvix
