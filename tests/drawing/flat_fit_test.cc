// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/flat_fit.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "gtest/gtest.h"
#include "tests/support/random.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

// A circle of radius 3, `tilt` out of the xz plane.
CurveFit TiltedArc(double tilt, double start, double end) {
  CurveFit fit;
  fit.kind = FitKind::kArc;
  fit.closed = end - start > 6.28;
  fit.center = {1, 2, 3};
  fit.major = {3, 0, 0};
  fit.minor = {0, 3 * std::sin(tilt), 3 * std::cos(tilt)};
  fit.start_angle = start;
  fit.end_angle = end;
  fit.start = PointAt(fit, 0);
  fit.end = PointAt(fit, 1);
  fit.sigma = 1e-3;
  return fit;
}

// Every point of `fit` is on `flat`, and the ends are.
void ExpectSameView(const CurveFit& fit,
                    const CurveFit& flat,
                    const DrawingPlane& plane,
                    double tolerance) {
  for (int i = 0; i <= 40; ++i) {
    const Vector3d seen = plane.Flat(PointAt(fit, i / 40.0));
    double nearest = 1e9;
    for (int k = 0; k <= 4000; ++k) {
      nearest = std::min(nearest, (PointAt(flat, k / 4000.0) - seen).norm());
    }
    EXPECT_LT(nearest, tolerance);
  }
}

TEST(FlatFit, ConicsAreSeenAsTheyAre) {
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    CurveFit fit = TiltedArc(0.3, -2.5, 1.5);
    fit.kind = FitKind::kEllipse;
    fit.minor *= 0.4;
    DrawingPlane plane = *AxisPlane("xy");
    const Vector3d a = random.NormalVector(), b = random.NormalVector();
    plane.toward = a.normalized();
    plane.right = a.cross(b).normalized();
    plane.up = plane.toward.cross(plane.right);
    plane.origin = random.NormalVector();
    const auto flat = FlatFit(fit, plane);
    ASSERT_TRUE(flat.has_value());
    if (flat->kind == FitKind::kEllipse) {
      EXPECT_GT(flat->major.cross(flat->minor).z(), 0);
      EXPECT_GE(flat->major.norm(), flat->minor.norm());
      EXPECT_NEAR(flat->major.dot(flat->minor), 0, 1e-9);
      EXPECT_TRUE(flat->start_angle > -kPi && flat->start_angle <= kPi);
    }
    ExpectSameView(fit, *flat, plane, 1e-2);
  }
}

TEST(FlatFit, ACircleIsAnEllipseAtASlantAndACircleFromTheFront) {
  const DrawingPlane front = *AxisPlane("xz");
  const auto slant = FlatFit(TiltedArc(kPi / 3, 0.4, 0.4 + 2 * kPi), front);
  ASSERT_TRUE(slant.has_value());
  EXPECT_EQ(slant->kind, FitKind::kEllipse);
  EXPECT_NEAR(slant->major.norm(), 3, 1e-12);
  EXPECT_NEAR(slant->minor.norm(), 1.5, 1e-12);
  EXPECT_TRUE(slant->closed);
  EXPECT_NEAR(slant->end_angle - slant->start_angle, 2 * kPi, 1e-12);

  const auto whole = FlatFit(TiltedArc(1e-3, 0.4, 0.4 + 2 * kPi), front);
  ASSERT_TRUE(whole.has_value());
  EXPECT_EQ(KindName(*whole), "circle");
  EXPECT_NEAR(whole->major.norm(), 3, 1e-12);
  const auto arc = FlatFit(TiltedArc(1e-3, 0.4, 1.4), FromBehind(front));
  ASSERT_TRUE(arc.has_value());
  EXPECT_EQ(KindName(*arc), "arc");
  ExpectSameView(TiltedArc(1e-3, 0.4, 1.4), *arc, FromBehind(front), 2e-3);
}

TEST(FlatFit, FromTheSideACircleIsALine) {
  const auto whole =
      FlatFit(TiltedArc(kPi / 2, 0.4, 0.4 + 2 * kPi), *AxisPlane("xz"));
  ASSERT_TRUE(whole.has_value());
  EXPECT_EQ(KindName(*whole), "line");
  EXPECT_NEAR(Length(*whole), 6, 1e-9);
  // From 0.4 to 1.4 radians.
  const CurveFit arc = TiltedArc(kPi / 2, 0.4, 1.4);
  const auto part = FlatFit(arc, *AxisPlane("xz"));
  ASSERT_TRUE(part.has_value());
  EXPECT_NEAR(Length(*part), 3 * (std::cos(0.4) - std::cos(1.4)), 1e-9);
}

TEST(FlatFit, LinesSeenEndOnAreLeftOut) {
  CurveFit line;
  line.end = {0, 5, 0};
  EXPECT_FALSE(FlatFit(line, *AxisPlane("xz")).has_value());
  EXPECT_NEAR(Length(*FlatFit(line, *AxisPlane("xy"))), 5, 1e-12);
}

TEST(DrawingPlane, AxesAreRightHandedAndNamed) {
  for (const char* name : {"xy", "xz", "yz"}) {
    const DrawingPlane plane = *AxisPlane(name);
    EXPECT_EQ(plane.right.cross(plane.up), plane.toward) << name;
    const DrawingPlane behind = FromBehind(plane);
    EXPECT_EQ(behind.right.cross(behind.up), behind.toward) << name;
    const Vector3d x(1, 2, 3);
    EXPECT_EQ(plane.Flat(x).x(), x(name[0] - 'x'));
    EXPECT_EQ(plane.Flat(x).y(), x(name[1] - 'x'));
    EXPECT_EQ(plane.Depth(x), x(plane.depth_name[0] - 'x'));
    EXPECT_EQ(behind.Depth(x), plane.Depth(x));
  }
  EXPECT_FALSE(AxisPlane("zz").has_value());
}

TEST(DrawingPlane, ThroughPointsFacesTheCameras) {
  const Vector3d a(1, 1, 1), b(3, 1, 1), c(1, 1, 9);
  const Vector3d up = Vector3d::UnitZ();
  for (const double side : {-1.0, 1.0}) {
    const auto plane = PlaneThrough(a, b, c, up, {0, side, -0.5});
    ASSERT_TRUE(plane.ok());
    EXPECT_LT((plane->toward - Vector3d(0, -side, 0)).norm(), 1e-12);
    EXPECT_LT((plane->up - up).norm(), 1e-12);
    EXPECT_LT((plane->right - Vector3d(side, 0, 0)).norm(), 1e-12);
    EXPECT_EQ(plane->Flat(a), Vector3d(0, 0, 0));
  }
  const auto level = PlaneThrough(a, c, b, Vector3d::UnitY(), {0, -1, 0});
  ASSERT_TRUE(level.ok());
  EXPECT_LT((level->right - Vector3d(0, 0, 1)).norm(), 1e-12);
  EXPECT_FALSE(PlaneThrough(a, b, 2 * b - a, up, up).ok());
}

// Windows in the plane x = 7, whose reveals go 0.2 deep.
FittedCurves Facade() {
  FittedCurves facade;
  const auto add = [&](const Vector3d& from, const Vector3d& to) {
    CurveFit line;
    line.start = from;
    line.end = to;
    facade.curves.push_back({{line}});
  };
  for (int i = 0; i < 5; ++i) {
    add({7, 3.0 * i, 0}, {7, 3.0 * i + 1, 0});
    add({7, 3.0 * i, 0}, {7, 3.0 * i, 2});
    add({7, 3.0 * i, 0}, {7.2, 3.0 * i, 0});
  }
  return facade;
}

std::vector<View> Toward(const Vector3d& target,
                         const std::vector<Vector3d>& centers) {
  std::vector<PosedView> views;
  for (const Vector3d& center : centers)
    views.push_back(LookAt(center, target));
  return ToScene(views).views;
}

TEST(DrawingPlane, MainDepthIsThatOfTheWallWithMostLines) {
  FittedCurves house;
  const auto add = [&](double depth, int num) {
    for (int i = 0; i < num; ++i) {
      CurveFit line;
      line.start = {0, depth, 0};
      line.end = {1, depth, 0};
      house.curves.push_back({{line}});
    }
  };
  add(2, 4);     // front
  add(2.01, 1);  // its frames
  add(9.9, 3);   // back
  add(10.1, 4);
  add(6, 1);
  const DrawingPlane front = *AxisPlane("xz");
  EXPECT_NEAR(MainDepth(house, front, -20, 20), 10, 0.3);
  // With nearly as many lines, the front is nearer to the viewer.
  add(2, 1);
  EXPECT_EQ(MainDepth(house, front, -20, 20), 2);
  EXPECT_NEAR(MainDepth(house, FromBehind(front), -20, 20), 10, 0.3);
  EXPECT_NEAR(MainDepth(house, front, 5, 20), 10, 0.3);
  EXPECT_EQ(MainDepth({}, front, -20, 20), 0);
  EXPECT_EQ(MainDepth({}, front, 5, 20), 5);
  // Without lines across the view, that of the others.
  FittedCurves posts;
  CurveFit away;
  away.start = {0, 5, 0};
  away.end = {0, 7, 0};
  posts.curves.push_back({{away}});
  EXPECT_EQ(MainDepth(posts, front, -20, 20), 6);
}

TEST(DrawingPlane, MainPlaneIsThatWhichMostViewsFace) {
  const FittedCurves facade = Facade();
  const DrawingPlane plane =
      MainPlane(facade,
                Eigen::Matrix3d::Identity(),
                Toward({7, 7, 1}, {{-9, 9, 1}, {0, 1, 5}, {7, 40, 1}}));
  EXPECT_EQ(plane.name, "yz");
  EXPECT_EQ(plane.toward, Vector3d(-1, 0, 0));
  EXPECT_EQ(plane.up, Vector3d(0, 0, 1));
  EXPECT_EQ(MainDepth(facade, plane, -1e9, 1e9), 7);
  // From above and the other side.
  const DrawingPlane plan =
      MainPlane(facade,
                Eigen::Matrix3d::Identity(),
                Toward({7, 7, 1}, {{6, 7, 40}, {7, 6, 30}, {20, 7, 1}}));
  EXPECT_EQ(plan.name, "xy");
  EXPECT_EQ(plan.toward, Vector3d(0, 0, 1));
}

TEST(DrawingPlane, LinesDecideBetweenPlanesThatAsManyViewsFace) {
  const DrawingPlane plane =
      MainPlane(Facade(),
                Eigen::Matrix3d::Identity(),
                Toward({7, 7, 1}, {{20, 7, 1}, {7, 20, 1}, {6, 7, 40}}));
  EXPECT_EQ(plane.name, "yz");
  EXPECT_EQ(plane.toward, Vector3d(1, 0, 0));
}

}  // namespace
}  // namespace curvix
