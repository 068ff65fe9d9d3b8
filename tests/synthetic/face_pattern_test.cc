// SPDX-License-Identifier: BSD-3-Clause
#include "synthetic/face_pattern.h"

#include "base/angles.h"
#include "synthetic/counter_random.h"
#include "synthetic/primitive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/synthetic/face_value.h"

namespace curvix {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

FaceArea Area(double width, double height, bool is_round = false) {
  return {{-width / 2, -height / 2}, {width / 2, height / 2}, is_round};
}

double DistanceTo(const TrueCurve& curve, const Vector2d& uv) {
  double nearest = 1e9;
  for (int i = 0; i <= 400; ++i) {
    const Vector3d at = curve.Position(curve.length * i / 400);
    nearest = std::min(nearest, (at.head<2>() - uv).norm());
  }
  return nearest;
}

struct PatternCase {
  SurfacePattern pattern;
  bool is_round;
};

class EveryPattern : public ::testing::TestWithParam<PatternCase> {};

TEST_P(EveryPattern, JumpsAcrossItsOutlinesByAnEighthAtLeast) {
  const FaceArea area = Area(0.9, 0.5, GetParam().is_round);
  const auto pattern = MakeFacePattern(GetParam().pattern, area, 1, 5);
  ASSERT_NE(pattern, nullptr);
  int num_tried = 0;
  for (const TrueCurve& curve : pattern->Outlines()) {
    EXPECT_EQ(curve.kind, CurveKind::kMarking);
    for (const double share : {0.13, 0.5, 0.83}) {
      const double s = share * curve.length;
      const Vector2d at = curve.Position(s).head<2>();
      const Vector2d along = curve.Tangent(s).head<2>();
      const Vector2d aside = 1e-6 * Vector2d(-along.y(), along.x());
      const bool is_inside = ((at - area.low).array() > 1e-3).all() &&
                             ((area.high - at).array() > 1e-3).all();
      if (!is_inside) continue;
      ++num_tried;
      const auto left = pattern->At(at + aside);
      const auto right = pattern->At(at - aside);
      EXPECT_GT(std::abs(left.tone - right.tone), 0.125);
      EXPECT_NE(left.patch_id, right.patch_id);
    }
  }
  EXPECT_GT(num_tried, 30);
}

TEST_P(EveryPattern, HasAnOutlineWhereverItsToneJumps) {
  const FaceArea area = Area(0.9, 0.5, GetParam().is_round);
  const auto pattern = MakeFacePattern(GetParam().pattern, area, 1, 5);
  const auto outlines = pattern->Outlines();
  int num_jumps = 0;
  std::uint64_t counter = 0;
  const auto next = [&](double low, double high) {
    return low + (high - low) * Uniform(Mix(3, counter++));
  };
  for (int i = 0; i < 2000; ++i) {
    const Vector2d a(next(area.low.x(), area.high.x()),
                     next(area.low.y(), area.high.y()));
    const double angle = next(0, 2 * kPi);
    const Vector2d b = a + 0.004 * Vector2d(std::cos(angle), std::sin(angle));
    const bool same = pattern->At(a).patch_id == pattern->At(b).patch_id;
    const bool is_inside = ((b - area.low).array() > 0).all() &&
                           ((area.high - b).array() > 0).all();
    if (same || !is_inside) continue;
    ++num_jumps;
    double nearest = 1e9;
    const Vector2d once_round(area.high.x() - area.low.x(), 0);
    for (const TrueCurve& curve : outlines) {
      nearest = std::min(nearest, DistanceTo(curve, a));
      if (!area.is_round) continue;
      nearest = std::min(nearest, DistanceTo(curve, a + once_round));
    }
    EXPECT_LT(nearest, 0.0045) << a.transpose();
  }
  EXPECT_GT(num_jumps, 30);
}

INSTANTIATE_TEST_SUITE_P(
    Patterns,
    EveryPattern,
    ::testing::Values(PatternCase{SurfacePattern::kBrick, false},
                      PatternCase{SurfacePattern::kBrick, true},
                      PatternCase{SurfacePattern::kWood, false},
                      PatternCase{SurfacePattern::kPrint, false},
                      PatternCase{SurfacePattern::kPrint, true}));

TEST(FacePatternTest, BricksAreAsLongAsTheyShouldBe) {
  // Four courses of four bricks, halves at the ends of every second.
  const auto bricks =
      MakeFacePattern(SurfacePattern::kBrick, Area(0.6, 0.26), 1, 0);
  double length = 0;
  for (const TrueCurve& curve : bricks->Outlines()) length += curve.length;
  const double joint = 0.011;
  const double height = 0.065 - joint;
  const double full = 2 * (0.15 - joint + height);
  const double half = 2 * (0.075 - joint + height);
  EXPECT_NEAR(length, 2 * 4 * full + 2 * (3 * full + 2 * half), 1e-9);
}

TEST(FacePatternTest, NarrowFacesStayPlain) {
  EXPECT_EQ(MakeFacePattern(SurfacePattern::kBrick, Area(1, 0.09), 1, 0),
            nullptr);
  EXPECT_EQ(MakeFacePattern(SurfacePattern::kNone, Area(1, 1), 1, 0), nullptr);
}

// A curve in the coordinates of a face, and the same in the world.
TEST(FaceFrameTest, CurvesLieWhereTheirCoordinatesSay) {
  SolidPrimitive cone = Frustum({1, 2, 3}, {0.2, 0.1, 0.5}, 0.3, 0.2);
  SolidPrimitive box = Box({0, 0, 0}, {0.4, 0.6, 0.8});
  box.world_from_own.rotation =
      Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized());
  for (const SolidPrimitive& primitive :
       {cone, box, FlatSheet({0, 0, 0}, {0.4, 0, 0}, {0, 0.1, 0.3})}) {
    for (int face = 0; face < NumFaces(primitive.shape); ++face) {
      for (const Vector3d& to :
           {Vector3d(0.15, 0.1, 0), Vector3d(0.05, 0.2, 0)}) {
        const TrueCurve flat = Segment({0.05, 0.1, 0}, to, CurveKind::kMarking);
        const TrueCurve curve = OnFace(primitive, face, flat);
        for (const double share : {0.0, 0.3, 1.0}) {
          const Vector2d uv = flat.Position(share * flat.length).head<2>();
          const Vector3d own = OwnFromFace(primitive, face, uv);
          EXPECT_NEAR(
              (FaceFromOwn(primitive, face, own) - uv).norm(), 0, 1e-12);
          const Vector3d world = primitive.world_from_own * own;
          EXPECT_NEAR(FaceValue(primitive, face, world), 0, 1e-12);
          EXPECT_NEAR(
              (curve.Position(share * curve.length) - world).norm(), 0, 1e-12);
        }
      }
    }
  }
}

}  // namespace
}  // namespace curvix
