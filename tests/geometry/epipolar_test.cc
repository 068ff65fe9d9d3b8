// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/epipolar.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/angles.h"
#include "tests/support/random.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct Rig {
  std::string name;
  PosedView view1, view2;
};

// Points in front of all of these lie around (0, 0, 5).
std::vector<Rig> Rigs() {
  const Matrix3d ahead = Matrix3d::Identity();
  const Matrix3d turned =
      AngleAxisd(0.4, Vector3d(0.2, 1, 0.1).normalized()).toRotationMatrix();
  std::vector<Rig> rigs;
  rigs.push_back({"epipoles at infinity",
                  MakeView(ahead, {0, 0, 0}),
                  MakeView(ahead, {1, 0, 0})});
  rigs.push_back({"epipoles inside the image",
                  MakeView(ahead, {0, 0, 0}),
                  MakeView(ahead, {0.1, 0.05, 1})});
  rigs.push_back({"epipole behind one camera",
                  MakeView(ahead, {0, 0, 0}),
                  MakeView(turned, {2, 0.3, 0.5})});
  rigs.push_back(
      {"cameras face to face",
       MakeView(ahead, {0.3, 0, 0}),
       MakeView(AngleAxisd(kPi, Vector3d::UnitY()).matrix(), {0.1, 0.2, 10})});
  rigs.push_back({"fx != fy",
                  MakeView(ahead, {0, 0, 0}),
                  MakeView(turned.transpose(), {-1, 1, 0})});
  rigs.back().view1.calibration(1, 1) = 500;
  rigs.back().view2.calibration(0, 0) = 300;
  return rigs;
}

Vector3d RandomPoint(Random& random) {
  return Vector3d(random.Uniform(-1.5, 1.5),
                  random.Uniform(-1.5, 1.5),
                  random.Uniform(3, 7));
}

TEST(EpipolarAngles, GivesAPointTheSameAngleInBothViews) {
  Random random(1);
  for (const Rig& rig : Rigs()) {
    const auto pencil = EpipolarPencil::Make(rig.view1, rig.view2);
    ASSERT_TRUE(pencil) << rig.name;
    int compared = 0;
    for (int i = 0; i < 200; ++i) {
      const Vector3d x = RandomPoint(random);
      const auto angle1 =
          EpipolarAngles(*pencil, rig.view1).AngleOf(PixelOf(rig.view1, x));
      const auto angle2 =
          EpipolarAngles(*pencil, rig.view2).AngleOf(PixelOf(rig.view2, x));
      if (!angle1 || !angle2) continue;  // near an epipole
      ++compared;
      EXPECT_LT(
          std::abs(std::remainder(angle1->angle - angle2->angle, 2 * kPi)),
          1e-11)
          << rig.name;
    }
    EXPECT_GT(compared, 150) << rig.name;
  }
}

TEST(EpipolarAngles, TellsTheTwoSidesOfTheEpipoleApart) {
  const Rig rig = Rigs()[1];
  const auto pencil = EpipolarPencil::Make(rig.view1, rig.view2);
  const Vector2d epipole = PixelOf(rig.view1, rig.view2.center);
  const Vector2d offset(30, 40);
  const auto one = EpipolarAngles(*pencil, rig.view1).AngleOf(epipole + offset);
  const auto other =
      EpipolarAngles(*pencil, rig.view1).AngleOf(epipole - offset);
  EXPECT_NEAR(
      std::abs(std::remainder(one->angle - other->angle, 2 * kPi)), kPi, 1e-12);
}

TEST(EpipolarAngles, HasNoAngleWithinHalfADegreeOfTheBaseline) {
  const Rig rig = Rigs()[1];
  const auto pencil = EpipolarPencil::Make(rig.view1, rig.view2);
  const Vector2d epipole = PixelOf(rig.view1, rig.view2.center);
  const double half_a_degree_px = 800 * std::tan(DegToRad(0.5));
  const Vector2d across(0, 1);
  EXPECT_FALSE(EpipolarAngles(*pencil, rig.view1).AngleOf(epipole));
  EXPECT_FALSE(EpipolarAngles(*pencil, rig.view1)
                   .AngleOf(epipole + 0.9 * half_a_degree_px * across));
  EXPECT_TRUE(EpipolarAngles(*pencil, rig.view1)
                  .AngleOf(epipole + 1.1 * half_a_degree_px * across));
}

// By finite differences.
double RadPerPx(const EpipolarPencil& pencil,
                const PosedView& view,
                const Vector2d& pixel) {
  const auto slope = [&](const Vector2d& h) {
    const double rise = EpipolarAngles(pencil, view).AngleOf(pixel + h)->angle -
                        EpipolarAngles(pencil, view).AngleOf(pixel - h)->angle;
    return std::remainder(rise, 2 * kPi) / (2 * h.norm());
  };
  return std::hypot(slope({1e-4, 0}), slope({0, 1e-4}));
}

TEST(EpipolarAngles, MovesPerPixelAsFiniteDifferencesDo) {
  Random random(2);
  for (const Rig& rig : Rigs()) {
    const auto pencil = EpipolarPencil::Make(rig.view1, rig.view2);
    for (const PosedView* view : {&rig.view1, &rig.view2}) {
      for (int i = 0; i < 50; ++i) {
        const Vector2d pixel(random.Uniform(0, 800), random.Uniform(0, 800));
        const auto angle = EpipolarAngles(*pencil, *view).AngleOf(pixel);
        if (!angle) continue;
        EXPECT_NEAR(
            RadPerPx(*pencil, *view, pixel) / angle->rad_per_px, 1, 1e-5)
            << rig.name;
      }
    }
  }
}

TEST(EpipolarPencil, PointsItsBaselineFromTheFirstViewToTheSecond) {
  for (const Rig& rig : Rigs()) {
    const auto pencil = EpipolarPencil::Make(rig.view1, rig.view2);
    EXPECT_TRUE(pencil->baseline().isApprox(
        (rig.view2.center - rig.view1.center).normalized(), 1e-12));
  }
}

TEST(EpipolarPencil, NeedsTwoCentres) {
  Random random(3);
  for (const double distance : {0.0, 1.0, 1e6}) {
    const Vector3d center = distance * random.UnitVector();
    PosedView view1 = MakeView(random.Rotation(), center);
    PosedView view2 = MakeView(random.Rotation(), center);
    // Centres as they come out of poses, with rounding errors.
    view1.center = -(view1.rotation.transpose() * view1.translation);
    view2.center = -(view2.rotation.transpose() * view2.translation);
    EXPECT_FALSE(EpipolarPencil::Make(view1, view2)) << distance;
  }
}

TEST(FundamentalMatrix, IsZeroOnTheImagesOfAPoint) {
  Random random(4);
  for (const Rig& rig : Rigs()) {
    const Matrix3d fundamental = FundamentalMatrix(rig.view1, rig.view2);
    for (int i = 0; i < 100; ++i) {
      const Vector3d x = RandomPoint(random);
      const Vector3d x1 = PixelOf(rig.view1, x).homogeneous();
      const Vector3d x2 = PixelOf(rig.view2, x).homogeneous();
      EXPECT_LT(std::abs(x2.dot(fundamental * x1)),
                1e-12 * fundamental.norm() * x1.norm() * x2.norm())
          << rig.name;
    }
  }
}

TEST(EpipolarLine, PassesThroughTheImageOfThePointInPixels) {
  Random random(5);
  for (const Rig& rig : Rigs()) {
    const Matrix3d fundamental = FundamentalMatrix(rig.view1, rig.view2);
    for (int i = 0; i < 100; ++i) {
      const Vector3d x = RandomPoint(random);
      const Line2 line = EpipolarLine(fundamental, PixelOf(rig.view1, x));
      const Vector2d x2 = PixelOf(rig.view2, x);
      EXPECT_NEAR(line.normal.norm(), 1, 1e-12);
      EXPECT_LT(std::abs(line.SignedDistance(x2)), 1e-8) << rig.name;
      EXPECT_NEAR(line.SignedDistance(x2 + 3 * line.normal), 3, 1e-8);
      EXPECT_NEAR(line.SignedDistance(x2 + 7 * line.Direction()), 0, 1e-8);
    }
  }
}

TEST(RayProjection, SeesTheDepthsOfARayAndNoOthers) {
  Random random(5);
  for (const Rig& rig : Rigs()) {
    const RayProjection projection(rig.view1, rig.view2);
    const Matrix3d fundamental = FundamentalMatrix(rig.view1, rig.view2);
    for (int trial = 0; trial < 100; ++trial) {
      const Vector3d x = rig.view1.InCamera(RandomPoint(random));
      const Vector2d pixel = rig.view1.Pixel(x);
      const Line2 line = EpipolarLine(fundamental, pixel);
      const double nearest = random.Uniform(2.5, 4);
      const double farthest = nearest + random.Uniform(0.5, 4);
      const Interval seen =
          projection.SeenAlong(line, pixel, nearest, farthest);
      for (double depth = 2; depth < 9; depth += 0.37) {
        const Vector3d place = rig.view1.center + depth * rig.view1.Ray(pixel);
        const Vector3d in_view2 = rig.view2.InCamera(place);
        if (!(in_view2.z() > 0)) continue;
        const double along = line.Direction().dot(rig.view2.Pixel(in_view2));
        EXPECT_EQ(seen.Contains(along), nearest <= depth && depth <= farthest)
            << rig.name << ", depth " << depth;
      }
      const Interval all = projection.SeenAlong(
          line, pixel, 0, std::numeric_limits<double>::infinity());
      EXPECT_TRUE(all.begin <= seen.begin && seen.end <= all.end) << rig.name;
    }
  }
}

TEST(RayProjection, SeesAllOfTheLineWhereAnEndIsBehind) {
  const Matrix3d ahead = Matrix3d::Identity();
  const PosedView view1 = MakeView(ahead, {0, 0, 0});
  const PosedView view2 = MakeView(ahead, {0.1, 0, 2});
  const Vector2d pixel(410, 420);
  const Line2 line = EpipolarLine(FundamentalMatrix(view1, view2), pixel);
  const Interval seen =
      RayProjection(view1, view2).SeenAlong(line, pixel, 1, 5);
  EXPECT_TRUE(std::isinf(seen.begin) && std::isinf(seen.end));
}

}  // namespace
}  // namespace curvix
