// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/refine_curves.h"

#include <gtest/gtest.h>

#include "tests/curve_refinement/drawn_curves.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

constexpr double kRoughnessPx = 0.1;

// The sides of a square of 100 px: noisy, broken in the middle, and not
// reaching the corners; and a curve whose place the views hardly tell.
std::vector<Curve> RoughSquare() {
  Random random(3);
  std::vector<Curve> curves;
  for (int side = 0; side < 4; ++side) {
    const Eigen::AngleAxisd turn(std::numbers::pi / 2 * side,
                                 Eigen::Vector3d::UnitY());
    curves.push_back(Line(turn * InPlane(-46, 50), turn * InPlane(-5, 50)));
    curves.push_back(Line(turn * InPlane(5, 50), turn * InPlane(46, 50)));
  }
  for (Curve& curve : curves) {
    for (CurveSample& sample : curve.samples) {
      sample.position += kRoughnessPx * kPixel * random.Across(sample.tangent);
    }
  }
  curves.push_back(Line(InPlane(-20, 0), InPlane(20, 0)));
  for (CurveSample& sample : curves.back().samples) sample.sigma = kPixel;
  return curves;
}

std::vector<Curve> RefineRoughSquare(const CurveRefinementOptions& options,
                                     int num_threads,
                                     const StepDone& step_done = {}) {
  std::vector<Curve> curves = RoughSquare();
  const std::vector<EdgeMap> edge_maps = SupportByEdges(FrontalViews(), curves);
  return RefineCurves(curves,
                      {FrontalViews(),
                       edge_maps,
                       kEdgeSigmaPx,
                       options,
                       num_threads,
                       step_done});
}

TEST(RefineCurves, DrawsASquareAsFourSidesBetweenCorners) {
  const std::vector<Curve> sides = RefineRoughSquare({}, 1);
  ASSERT_EQ(sides.size(), 4u);
  for (const Curve& side : sides) {
    EXPECT_NEAR(Length(side) / kPixel, 100, 1);
    for (const CurveSample& end : {side.samples.front(), side.samples.back()}) {
      int num_meeting = 0;
      for (const Curve& other : sides) {
        num_meeting += end.position == other.samples.front().position;
        num_meeting += end.position == other.samples.back().position;
      }
      EXPECT_EQ(num_meeting, 2);
      EXPECT_NEAR(std::abs(end.position.x()) / kPixel, 50, 3 * kRoughnessPx);
      EXPECT_NEAR(std::abs(end.position.z()) / kPixel, 50, 3 * kRoughnessPx);
    }
  }
}

TEST(RefineCurves, ChangesNothingWhenItIsOff) {
  CurveRefinementOptions options;
  options.enabled = false;
  EXPECT_EQ(LargestDistance(RefineRoughSquare(options, 1), RoughSquare()), 0);
}

TEST(RefineCurves, StopsWheneverItIsAskedTo) {
  int num_calls = 0;
  const std::vector<Curve> whole =
      RefineRoughSquare({}, 1, [&](int, int) { return ++num_calls > 0; });
  EXPECT_EQ(LargestDistance(whole, RefineRoughSquare({}, 1)), 0);
  // Between steps, and between curves where that takes long.
  EXPECT_GT(num_calls, 4 * static_cast<int>(whole.size()));
  for (int last = 1; last <= num_calls - 4; ++last) {
    int calls = 0;
    const auto refined =
        RefineRoughSquare({}, 1, [&](int, int) { return ++calls < last; });
    EXPECT_TRUE(refined.empty()) << last;
  }
}

TEST(RefineCurves, ThreadsChangeNothing) {
  EXPECT_EQ(LargestDistance(RefineRoughSquare({}, 3), RefineRoughSquare({}, 1)),
            0);
}

}  // namespace
}  // namespace curvix
