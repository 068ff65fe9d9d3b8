// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/refine_curves.h"

#include <gtest/gtest.h>

#include "base/angles.h"
#include "model/curve_chains.h"
#include "tests/curve_refinement/touching_curves.h"

namespace curvix {
namespace {

std::vector<Curve> Cut(const std::vector<Curve>& curves) {
  return CutAtTouches(curves, {FrontalViews(), {}, kEdgeSigmaPx, {}, 1});
}

TEST(CutAtTouches, FourPiecesEndWhereTwoCurvesTouch) {
  for (const double apart_px : {0.0, 0.5}) {
    std::vector<Curve> curves = {ArcUpwards(), ArcBackwards()};
    for (CurveSample& sample : curves[0].samples) {
      sample.position.z() += apart_px * kPixel;
    }
    CurveSet cut{Cut(curves), {}};
    ASSERT_EQ(cut.curves.size(), 4u);
    IndexJunctions(cut);
    ASSERT_EQ(cut.junctions.size(), 1u);
    EXPECT_EQ(cut.junctions[0].num_ends, 4);
    EXPECT_LT(cut.junctions[0].position.norm(), 2 * kPixel);
    for (const Curve& piece : cut.curves) {
      EXPECT_NEAR(Length(piece), kTouchIdx * kPixel, 2 * kPixel);
    }
  }
}

// A circle that touches ArcBackwards(); its first sample lies `start` samples
// from the touch.
Curve TouchingCircle(int start) {
  Curve circle = Arc(kTouchRadiusPx, 0, 2 * kPi);
  for (CurveSample& sample : circle.samples) {
    sample.position += InPlane(0, kTouchRadiusPx);
  }
  const auto touch = static_cast<int>(
      std::min_element(circle.samples.begin(),
                       circle.samples.end(),
                       [](const auto& a, const auto& b) {
                         return a.position.norm() < b.position.norm();
                       }) -
      circle.samples.begin());
  std::rotate(circle.samples.begin(),
              circle.samples.begin() + touch + start,
              circle.samples.end());
  return circle;
}

TEST(CutAtTouches, AClosedCurveIsOpenedWhereverItBegins) {
  for (const int start : {-40, -14, -5, 0, 1, 10, 20, 60}) {
    const Curve circle = TouchingCircle(start);
    const auto cut = Cut({circle, ArcBackwards()});
    ASSERT_EQ(cut.size(), 3u) << start;
    EXPECT_FALSE(cut[0].closed);
    EXPECT_EQ(cut[0].samples.front().position, cut[0].samples.back().position);
    EXPECT_LT(cut[0].samples.front().position.norm(), 2 * kPixel) << start;
    EXPECT_NEAR(Length(cut[0]), Length(circle), kPixel);
  }
}

TEST(CutAtTouches, NoOtherJunctionIsMadeOfTheEnds) {
  // Lines that cross at 8 degrees, and a third one that ends beside the place.
  const double angle = DegToRad(8);
  const Eigen::Vector3d way = InPlane(std::cos(angle), std::sin(angle));
  const std::vector<Curve> curves = {Line(InPlane(-60, 0), InPlane(60, 0)),
                                     Line(-60 * way, 60 * way),
                                     Line(InPlane(1, 2), InPlane(20, 50))};
  CurveSet met{
      MeetAtJunctions(Cut(curves), {FrontalViews(), {}, kEdgeSigmaPx, {}, 1}),
      {}};
  IndexJunctions(met);
  ASSERT_EQ(met.curves.size(), 5u);
  ASSERT_EQ(met.junctions.size(), 1u);
  EXPECT_EQ(met.junctions[0].num_ends, 4);
}

TEST(CutAtTouches, CurvesBesideEachOtherStayWhole) {
  EXPECT_EQ(Cut({Line(InPlane(-60, 0), InPlane(60, 0)),
                 Line(InPlane(-50, 0.8), InPlane(50, 0.8))})
                .size(),
            2u);
  std::vector<Curve> curves = {ArcUpwards(), ArcBackwards()};
  for (CurveSample& sample : curves[0].samples) {
    sample.position.z() += 1.5 * kPixel;
  }
  EXPECT_EQ(Cut(curves).size(), 2u);
  EXPECT_EQ(Cut({Arc(20, 0, 2 * kPi), Arc(20.9, 0, 2 * kPi)}).size(), 2u);
  EXPECT_EQ(Cut({Arc(30, 0, 5), Arc(30.5, 0, 5)}).size(), 2u);
}

TEST(CutAtTouches, CurvesThatCrossOrMeetInACornerStayWhole) {
  EXPECT_EQ(Cut({Line(InPlane(-60, 0), InPlane(60, 0)),
                 Line(InPlane(0, -60), InPlane(0, 60))})
                .size(),
            2u);
  EXPECT_EQ(Cut({Line(InPlane(0, 0), InPlane(60, 0)),
                 Line(InPlane(0, 0), InPlane(60, 10))})
                .size(),
            2u);
}

}  // namespace
}  // namespace curvix
