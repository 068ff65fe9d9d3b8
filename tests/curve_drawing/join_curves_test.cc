// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/group_edges.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>

#include "geometry/pixel_size.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

const std::vector<PosedView>& Views() {
  static const std::vector<PosedView> views = RingOfViews(8);
  return views;
}

// A sample every pixel along x from x0 to x1 (either order), in pixels.
Curve Straight(double x0, double x1, double y = 0) {
  Curve curve;
  const double sign = x1 < x0 ? -1 : 1;
  for (double x = x0; sign * x <= sign * x1; x += sign) {
    CurveSample sample;
    sample.position = {x * kPx, y * kPx, 0};
    sample.tangent = sign * Eigen::Vector3d::UnitX();
    curve.samples.push_back(sample);
  }
  return curve;
}

Curve Arc(double radius_px, double from_rad, double to_rad) {
  Curve curve;
  for (double a = from_rad; a <= to_rad; a += 1 / radius_px) {
    CurveSample sample;
    sample.position =
        radius_px * kPx * Eigen::Vector3d(std::cos(a), std::sin(a), 0);
    sample.tangent = Eigen::Vector3d(-std::sin(a), std::cos(a), 0);
    curve.samples.push_back(sample);
  }
  return curve;
}

// Every step of the curve must agree with the tangents at both ends.
void ExpectOrdered(const Curve& curve) {
  for (std::size_t k = 1; k < curve.samples.size(); ++k) {
    const Eigen::Vector3d step =
        curve.samples[k].position - curve.samples[k - 1].position;
    EXPECT_GT(step.dot(curve.samples[k].tangent), 0) << "sample " << k;
    EXPECT_GT(step.dot(curve.samples[k - 1].tangent), 0) << "sample " << k;
  }
}

TEST(JoinCurves, JoinsEndsThatContinueEachOtherInAnyDirection) {
  for (const bool reverse : {false, true}) {
    const Curve second = reverse ? Straight(35, 15) : Straight(15, 35);
    const auto joined = JoinCurves({Straight(0, 10), second}, Views(), {});
    ASSERT_EQ(joined.size(), 1u);
    EXPECT_FALSE(joined[0].closed);
    EXPECT_EQ(joined[0].samples.size(), 32u);
    EXPECT_NEAR(Length(joined[0]), 35 * kPx, 1e-12);
    ExpectOrdered(joined[0]);
  }
}

TEST(JoinCurves, LeavesWideGapsParallelTracksAndCorners) {
  const Curve first = Straight(0, 10);
  Curve corner = Straight(0, 10);
  for (CurveSample& sample : corner.samples) {
    const double x = sample.position.x();
    sample.position = {10 * kPx, x + kPx, 0};
    sample.tangent = Eigen::Vector3d::UnitY();
  }
  for (const Curve& second :
       {Straight(30, 40), Straight(12, 22, 4), Straight(0, 10, 2), corner}) {
    EXPECT_EQ(JoinCurves({first, second}, Views(), {}).size(), 2u);
  }
}

TEST(JoinCurves, ClosesACurveWhoseEndsMeet) {
  const auto joined = JoinCurves({Arc(40, 0, 6.2)}, Views(), {});
  ASSERT_EQ(joined.size(), 1u);
  EXPECT_TRUE(joined[0].closed);
  ExpectOrdered(joined[0]);
}

TEST(JoinCurves, PrefersTheNearestEnd) {
  const auto joined = JoinCurves(
      {Straight(0, 10), Straight(17, 30), Straight(13, 14, 0.2)}, Views(), {});
  ASSERT_EQ(joined.size(), 1u);
  ExpectOrdered(joined[0]);
}

TEST(JoinCurves, LeavesClosedCurvesAndTakesNone) {
  Curve ring = Arc(40, 0, 6.2);
  ring.closed = true;
  const auto joined = JoinCurves({ring}, Views(), {});
  ASSERT_EQ(joined.size(), 1u);
  EXPECT_TRUE(joined[0].closed);
  EXPECT_EQ(joined[0].samples.size(), ring.samples.size());
  EXPECT_TRUE(JoinCurves({}, Views(), {}).empty());
}

TEST(DropDuplicates, KeepsTheLongerOfTwoTracksAndWhatItDoesNotCover) {
  const auto kept =
      DropDuplicates({Straight(5, 60, 0.5), Straight(0, 100)}, Views(), {});
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0].samples.size(), 101u);
  const auto split =
      DropDuplicates({Straight(40, -20, 0.5), Straight(0, 100)}, Views(), {});
  ASSERT_EQ(split.size(), 2u);
  EXPECT_LT(split[0].samples.size(), 21u);
  EXPECT_GT(split[0].samples.size(), 15u);
}

TEST(DropDuplicates, KeepsCurvesThatAreApartOrCross) {
  Curve across = Straight(-20, 20);
  for (CurveSample& sample : across.samples) {
    std::swap(sample.position.x(), sample.position.y());
    sample.tangent = Eigen::Vector3d::UnitY();
  }
  const auto kept = DropDuplicates(
      {Straight(-30, 30), Straight(-20, 20, 2), across}, Views(), {});
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[0].samples.size(), 61u);
  EXPECT_EQ(kept[1].samples.size(), 41u);
  EXPECT_EQ(kept[2].samples.size(), 41u);
}

TEST(DropDuplicates, UnwindsACurveThatRunsTwiceRound) {
  const auto kept = DropDuplicates({Arc(40, 0, 12.5)}, Views(), {});
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_NEAR(Length(kept[0]), 6.283 * 40 * kPx, 5 * kPx);
}

TEST(DropDuplicates, KeepsAWholeRing) {
  Curve ring = Arc(40, 0, 6.28);
  ring.closed = true;
  const auto kept = DropDuplicates({ring}, Views(), {});
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_TRUE(kept[0].closed);
  EXPECT_EQ(kept[0].samples.size(), ring.samples.size());
}

TEST(IsShort, MeasuresInPixelsOfTheNearestView) {
  // The origin is 6.5 away, focal length 800.
  const double px = 6.5 / 800;
  Curve curve = Straight(0, 1);
  curve.samples[1].position.x() = 10 * px;
  EXPECT_NEAR(LengthInPixels(curve, Views()), 10, 0.2);
  EXPECT_FALSE(IsShort(curve, Views(), 9.5));
  EXPECT_TRUE(IsShort(curve, Views(), 10.5));
  EXPECT_TRUE(IsShort(Straight(0, 0), Views(), 0));
}

}  // namespace
}  // namespace curvix
