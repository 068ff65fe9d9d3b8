// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/curve_ends.h"

#include <gtest/gtest.h>

#include "tests/curve_refinement/drawn_curves.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

TEST(FitEnd, AnArcGoesOnAsItBegan) {
  for (const double radius_px : {14.0, 60.0, 400.0}) {
    const double angle = 30 / radius_px;
    const Curve arc = Arc(radius_px, kQuarter - angle, kQuarter);
    const EndFit fit = FitEnd(arc, true, {2, 20}, FrontalViews());
    EXPECT_NEAR(fit.bend.norm() * radius_px * kPixel, 1, 0.01) << radius_px;
    // Up to half a turn of the small ones.
    const double ahead = std::min(20 / radius_px, 1.5);
    const Eigen::Vector3d there =
        InPlane(radius_px * std::cos(kQuarter + ahead),
                radius_px * std::sin(kQuarter + ahead));
    const double arc_length = fit.ArcLengthTo(there);
    EXPECT_NEAR(arc_length, ahead * radius_px * kPixel, 0.1 * kPixel);
    EXPECT_LT((fit.PointAt(arc_length) - there).norm(), 0.15 * kPixel);
    EXPECT_NEAR(fit.DirectionAt(arc_length).dot(there.normalized()), 0, 0.01);
  }
}

TEST(FitEnd, ALineIsALineInSpiteOfNoise) {
  Random random(5);
  Curve line = Line(InPlane(-60, 0), InPlane(0, 0));
  for (CurveSample& sample : line.samples) {
    sample.position += 0.1 * kPixel * random.Across(sample.tangent);
  }
  const EndFit head = FitEnd(line, true, {0, 20}, FrontalViews());
  EXPECT_EQ(head.bend.norm(), 0);
  EXPECT_NEAR(head.outward.x(), 1, 1e-3);
  const EndFit tail = FitEnd(line, false, {0, 20}, FrontalViews());
  EXPECT_NEAR(tail.outward.x(), -1, 1e-3);
}

TEST(FitEnd, AnOutlierHardlyMatters) {
  Curve line = Line(InPlane(-60, 0), InPlane(0, 0));
  line.samples[55].position += InPlane(0, 2);
  const EndFit fit = FitEnd(line, true, {0, 20}, FrontalViews());
  EXPECT_LT(std::abs(fit.PointAt(10 * kPixel).z()), 0.1 * kPixel);
}

TEST(FitEnd, WhatIsNoEndHasNoFit) {
  const Curve circle = Arc(20, 0, 4 * kQuarter);
  EXPECT_EQ(FitEnd(circle, true, {0, 20}, FrontalViews()).length, 0);
  const Curve dot = Line(InPlane(0, 0), InPlane(2, 0));
  EXPECT_EQ(FitEnd(dot, true, {0, 20}, FrontalViews()).length, 0);
}

TEST(FitLongEnd, IsAsLongAsTheCurveIsOneArc) {
  Curve curve = Line(InPlane(-100, 0), InPlane(0, 0));
  EXPECT_GT(FitLongEnd(curve, true, FrontalViews()).length, 55 * kPixel);
  // Bent 20 px before the end.
  for (std::size_t k = 0; k < 80; ++k) {
    curve.samples[k].position.z() = 0.5 * (curve.samples[k].position.x() + 0.2);
  }
  EXPECT_LT(FitLongEnd(curve, true, FrontalViews()).length, 30 * kPixel);
}

}  // namespace
}  // namespace curvix
