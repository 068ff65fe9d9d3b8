// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/refine_curves.h"

#include <gtest/gtest.h>

#include "base/angles.h"
#include "model/curve_chains.h"
#include "tests/curve_refinement/drawn_curves.h"

namespace curvix {
namespace {

std::vector<Curve> CutOne(const Curve& curve, double max_corner_deg = 15) {
  return CutCorners({curve},
                    {FrontalViews(),
                     {},
                     kEdgeSigmaPx,
                     {.max_corner_deg = max_corner_deg},
                     1});
}

void Append(const Curve& next, Curve& curve) {
  curve.samples.insert(
      curve.samples.end(), next.samples.begin() + 1, next.samples.end());
}

Eigen::Vector3d Towards(double angle_deg, double length_px) {
  const double angle = DegToRad(angle_deg);
  return InPlane(length_px * std::cos(angle), length_px * std::sin(angle));
}

// 60 px to the origin and 60 px on, in a direction that differs by `turn_deg`.
Curve BentLine(double turn_deg) {
  Curve curve = Line(InPlane(-60, 0), InPlane(0, 0));
  Append(Line(InPlane(0, 0), Towards(turn_deg, 60)), curve);
  return curve;
}

// Every second sample is moved by `distance_px` out of the plane.
Curve Roughened(Curve curve, double distance_px) {
  for (std::size_t k = 0; k < curve.samples.size(); k += 2) {
    curve.samples[k].position.y() += distance_px * kPixel;
  }
  return curve;
}

TEST(CutCorners, CutsAtACornerAndNowhereElse) {
  for (const double roughness_px : {0.0, 0.05}) {
    for (const double turn_deg : {18.0, 30.0, 60.0, 90.0}) {
      const auto pieces = CutOne(Roughened(BentLine(turn_deg), roughness_px));
      ASSERT_EQ(pieces.size(), 2u) << turn_deg;
      const CurveSample& end = pieces[0].samples.back();
      EXPECT_EQ(end.position, pieces[1].samples.front().position);
      EXPECT_LT(end.position.norm(), 1.5 * kPixel) << turn_deg;
      EXPECT_NEAR(
          Length(pieces[0]) + Length(pieces[1]), 120 * kPixel, 0.3 * kPixel);
    }
  }
}

TEST(CutCorners, CornersUpToTheLimitStay) {
  EXPECT_EQ(CutOne(BentLine(12)).size(), 1u);
  EXPECT_EQ(CutOne(BentLine(12), 8).size(), 2u);
  EXPECT_EQ(CutOne(BentLine(30), 40).size(), 1u);
  EXPECT_EQ(CutOne(BentLine(90), 180).size(), 1u);
}

TEST(CutCorners, CornersBetweenArcsAreFound) {
  // Two arcs of 100 px that meet in the origin at 140 degrees.
  const double tilt = DegToRad(20);
  Curve curve = Arc(100, kPi / 2, kPi / 2 + 0.6);
  std::reverse(curve.samples.begin(), curve.samples.end());
  for (CurveSample& sample : curve.samples) {
    sample.position -= InPlane(0, 100);
    sample.tangent = -sample.tangent;
    sample.position =
        Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()) * sample.position;
    sample.tangent =
        Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()) * sample.tangent;
  }
  Curve mirrored = curve;
  std::reverse(mirrored.samples.begin(), mirrored.samples.end());
  for (CurveSample& sample : mirrored.samples) {
    sample.position.x() = -sample.position.x();
    sample.tangent = {sample.tangent.x(), 0, -sample.tangent.z()};
  }
  Append(mirrored, curve);
  const auto pieces = CutOne(curve);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_LT(pieces[1].samples.front().position.norm(), 1.5 * kPixel);
}

TEST(CutCorners, WavesStayWhole) {
  for (const double length_px : {40.0, 50.0, 60.0, 80.0}) {
    for (const double amplitude_px : {1.0, 2.0, 4.0, 6.0}) {
      EXPECT_EQ(CutOne(Wave(length_px, amplitude_px, 0, 240)).size(), 1u)
          << length_px << " " << amplitude_px;
    }
  }
}

TEST(CutCorners, BendsStayWhole) {
  for (const double radius_px : {6.0, 10.0, 20.0, 40.0, 100.0}) {
    for (const double roughness_px : {0.0, 0.05}) {
      EXPECT_EQ(
          CutOne(Roughened(Arc(radius_px, 0, 2 * kPi), roughness_px)).size(),
          1u)
          << radius_px;
      EXPECT_EQ(CutOne(Roughened(Arc(radius_px, 0, 3), roughness_px)).size(),
                1u)
          << radius_px;
    }
  }
}

TEST(CutCorners, ALineMayRunOnAsAnArc) {
  for (const double radius_px : {10.0, 15.0, 25.0, 50.0}) {
    Curve curve = Line(InPlane(radius_px, -60), InPlane(radius_px, 0));
    Append(Arc(radius_px, 0, kPi / 2), curve);
    Append(Line(InPlane(0, radius_px), InPlane(-60, radius_px)), curve);
    EXPECT_EQ(CutOne(curve).size(), 1u) << radius_px;
  }
}

TEST(CutCorners, AClosedHexagonFallsIntoItsSides) {
  Curve hexagon;
  for (int i = 0; i < 6; ++i) {
    const Curve side = Line(Towards(60 * i, 80), Towards(60 * (i + 1), 80));
    hexagon.samples.insert(
        hexagon.samples.end(), side.samples.begin(), side.samples.end() - 1);
  }
  hexagon.closed = true;
  std::rotate(hexagon.samples.begin(),
              hexagon.samples.begin() + 30,
              hexagon.samples.end());
  CurveSet sides{CutOne(hexagon), {}};
  ASSERT_EQ(sides.curves.size(), 6u);
  IndexJunctions(sides);
  EXPECT_EQ(sides.junctions.size(), 6u);
  for (const Curve& side : sides.curves) {
    EXPECT_FALSE(side.closed);
    EXPECT_NEAR(Length(side), 80 * kPixel, 2.5 * kPixel);
  }
}

TEST(CutCorners, IsFreeOfScale) {
  for (const double factor : {1e-3, 1e3}) {
    const auto views = Scaled(FrontalViews(), factor);
    const auto cut = CutCorners(Scaled({BentLine(20)}, factor),
                                {views, {}, kEdgeSigmaPx, {}, 1});
    EXPECT_LT(LargestDistance(Scaled(CutOne(BentLine(20)), factor), cut),
              1e-9 * factor);
  }
}

}  // namespace
}  // namespace curvix
