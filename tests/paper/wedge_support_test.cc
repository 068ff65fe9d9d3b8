// SPDX-License-Identifier: BSD-3-Clause
#include "paper/sketch_by_pairs.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/angles.h"
#include "geometry/detected_edge.h"
#include "tests/support/random.h"
#include "tests/support/synthetic_edges.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Vector2d;

constexpr double kTolerancePx = 0.3;
const double kMaxAngle = DegToRad(15);
const PosedView kH1 = LookAt({6, 0, 1}, {0, 0, 0});
const PosedView kH2 = LookAt({5.5, 2, 0}, {0, 0, 0});
const PosedView kView = LookAt({5, 1, 3}, {0, 0, 0});

// By how much the disc around `pixel` of kView misses the epipolar wedge of the
// disc around `pixel1`; negative where they meet. From epipolar lines, without
// angles.
double GapPx(const PosedView& h,
             const Vector2d& pixel1,
             const Vector2d& pixel) {
  const Eigen::Matrix3d fundamental = FundamentalMatrix(h, kView);
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  const Line2 middle = EpipolarLine(fundamental, pixel1);
  for (int k = 0; k < 360; ++k) {
    const double a = DegToRad(k);
    Line2 line = EpipolarLine(
        fundamental,
        pixel1 + kTolerancePx * Vector2d(std::cos(a), std::sin(a)));
    if (line.normal.dot(middle.normal) < 0) {
      line = {-line.normal, -line.offset};
    }
    least = std::min(least, line.SignedDistance(pixel));
    most = std::max(most, line.SignedDistance(pixel));
  }
  return std::max(least, -most) - kTolerancePx;
}

// A hypothesis and how it looks in all three views.
struct Case {
  ImageEdge edge1, edge2, projected;
};
Case RandomCase(Random& random) {
  const SpaceEdge edge{0.8 * random.UnitVector(), random.UnitVector()};
  return {*ProjectEdge(kH1, edge),
          *ProjectEdge(kH2, edge),
          *ProjectEdge(kView, edge)};
}

Edge2d EdgeAt(const Vector2d& position, double angle) {
  Edge2d edge;
  edge.position = position;
  edge.angle = static_cast<float>(angle);
  return edge;
}

double AngleOf(const ImageEdge& edge) {
  return std::atan2(edge.tangent.y(), edge.tangent.x());
}

std::optional<std::int32_t> Find(const Case& c,
                                 const std::vector<Edge2d>& edges) {
  const WedgeSupport support(*EpipolarPencil::Make(kH1, kView),
                             *EpipolarPencil::Make(kH2, kView),
                             kH1,
                             kH2,
                             kView,
                             edges,
                             kTolerancePx);
  return support.Find(c.edge1, c.edge2, c.projected, kMaxAngle);
}

TEST(WedgeSupport, HoldsExactlyWhatLiesInBothWedges) {
  Random random(1);
  int inside = 0, outside = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Case c = RandomCase(random);
    const Vector2d pixel =
        c.projected.position +
        Vector2d(random.Uniform(-3, 3), random.Uniform(-3, 3));
    const double gap = std::max(GapPx(kH1, c.edge1.position, pixel),
                                GapPx(kH2, c.edge2.position, pixel));
    if (std::abs(gap) < 0.005) continue;  // on the rim
    const bool found = Find(c, {EdgeAt(pixel, AngleOf(c.projected))}) == 0;
    EXPECT_EQ(found, gap < 0) << "gap " << gap;
    ++(found ? inside : outside);
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(outside, 100);
}

TEST(WedgeSupport, WantsTheProjectedDirectionUpToItsSign) {
  Random random(2);
  const Case c = RandomCase(random);
  const auto found_at = [&](double off_deg) {
    return Find(c,
                {EdgeAt(c.projected.position,
                        AngleOf(c.projected) + DegToRad(off_deg))})
        .has_value();
  };
  EXPECT_TRUE(found_at(0));
  EXPECT_TRUE(found_at(14.9));
  EXPECT_TRUE(found_at(-14.9));
  EXPECT_TRUE(found_at(180 + 14.9));
  EXPECT_FALSE(found_at(15.1));
  EXPECT_FALSE(found_at(-15.1));
}

TEST(WedgeSupport, TakesTheNearestAndOfEqualsTheFirst) {
  Random random(3);
  const Case c = RandomCase(random);
  const double angle = AngleOf(c.projected);
  const Vector2d& p = c.projected.position;
  const Vector2d step(0.05, 0);
  EXPECT_EQ(Find(c,
                 {EdgeAt(p + 2 * step, angle),
                  EdgeAt(p, angle + 2),  // another direction
                  EdgeAt(p + step, angle),
                  EdgeAt(p + step, angle)}),
            2);
}

TEST(WedgeSupport, FindsNothingAmongNoEdges) {
  Random random(4);
  EXPECT_FALSE(Find(RandomCase(random), {}));
}

}  // namespace
}  // namespace curvix
