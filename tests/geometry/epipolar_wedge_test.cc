// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/epipolar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/angles.h"
#include "tests/support/random.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;

const PosedView kView1 = MakeView(Matrix3d::Identity(), {0, 0, 0});
// Moved forwards: the epipole is in the image, so angles take all values.
const PosedView kView2 = MakeView(Matrix3d::Identity(), {0.1, 0.2, 1});

EpipolarAngles Angles2() {
  return {*EpipolarPencil::Make(kView1, kView2), kView2};
}

double Difference(double a, double b) {
  return std::abs(std::remainder(a - b, 2 * kPi));
}

std::vector<Edge2d> RandomEdges(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Edge2d> edges(static_cast<std::size_t>(count));
  for (Edge2d& edge : edges) {
    edge.position = {random.Uniform(0, 800), random.Uniform(0, 800)};
  }
  return edges;
}

std::vector<std::int32_t> AllThatMeet(const Wedge& wanted,
                                      const std::vector<Edge2d>& edges,
                                      double tolerance_px) {
  std::vector<std::int32_t> meeting;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto wedge = WedgeOf(Angles2(), edges[i].position, tolerance_px);
    if (wedge && Meet(*wedge, wanted)) {
      meeting.push_back(static_cast<std::int32_t>(i));
    }
  }
  return meeting;
}

TEST(WedgeOf, HoldsTheEpipolarAnglesOfTheDiscAndNoMore) {
  for (const Edge2d& edge : RandomEdges(300, 1)) {
    const double radius_px = 0.3;
    const auto wedge = WedgeOf(Angles2(), edge.position, radius_px);
    if (!wedge) continue;
    double widest = 0;
    for (int k = 0; k < 64; ++k) {
      const double a = 2 * kPi * k / 64;
      const Vector2d contour =
          edge.position + radius_px * Vector2d(std::cos(a), std::sin(a));
      widest = std::max(
          widest, Difference(Angles2().AngleOf(contour)->angle, wedge->center));
    }
    // The half-width is that of a disc of small angle; the rest is of second
    // order in it.
    EXPECT_NEAR(widest / wedge->half_width, 1, 0.002 + wedge->half_width);
  }
}

TEST(WedgeOf, DoesNotExistNearTheBaseline) {
  const Vector2d epipole = kView1.Pixel(kView1.InCamera(kView2.center));
  EXPECT_FALSE(
      WedgeOf(EpipolarAngles(*EpipolarPencil::Make(kView1, kView2), kView1),
              epipole,
              0.3));
}

TEST(Meet, ComparesIntervalsAcrossTheWrap) {
  EXPECT_TRUE(Meet({0.1, 0.05}, {0.2, 0.06}));
  EXPECT_FALSE(Meet({0.1, 0.05}, {0.2, 0.04}));
  EXPECT_TRUE(Meet({kPi - 0.01, 0.02}, {-kPi + 0.01, 0.01}));
  EXPECT_FALSE(Meet({kPi - 0.01, 0.005}, {-kPi + 0.01, 0.01}));
  EXPECT_FALSE(Meet({0, 0.1}, {kPi, 0.1}));
}

TEST(SortedByAngle, FindsTheEdgesThatBruteForceFinds) {
  const std::vector<Edge2d> edges = RandomEdges(3000, 2);
  for (const double tolerance_px : {0.3, 5.0}) {
    const SortedByAngle sorted(Angles2(), edges, tolerance_px);
    for (const double center :
         {-3.1415, -3.1, -1.0, 0.0, 0.5, 2.0, 3.12, 3.14159, kPi}) {
      for (const double half_width : {0.0, 0.002, 0.2}) {
        const Wedge wanted{center, half_width};
        EXPECT_EQ(sorted.Meeting(wanted),
                  AllThatMeet(wanted, edges, tolerance_px))
            << center << " +- " << half_width;
      }
    }
  }
}

TEST(SortedByAngle, FindsNothingAmongNoEdges) {
  EXPECT_THAT(SortedByAngle(Angles2(), {}, 0.3).Meeting({0, 4}),
              ::testing::IsEmpty());
}

}  // namespace
}  // namespace curvix
