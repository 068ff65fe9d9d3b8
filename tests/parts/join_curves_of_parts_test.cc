// SPDX-License-Identifier: BSD-3-Clause
#include "parts/join_curves_of_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/angles.h"
#include "parts/cut_curves.h"
#include "parts/regions.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

using Curves = std::vector<Curve>;

// About one pixel at the origin; see RingOfViews.
constexpr double kPx = 0.0075;

const std::vector<PosedView>& Views() {
  static const std::vector<PosedView> views = RingOfViews(8);
  return views;
}

// Two parts, divided at x = 0.
ScenePartition Halves() {
  ScenePartition partition;
  partition.overlap = 25 * kPx;
  partition.cuts = {{Eigen::Vector3d::UnitX(), 0, -1, -2}};
  partition.parts.resize(2);
  return partition;
}

// A sample every pixel from `from` to `to`, in pixels; `shift` moves the first
// one along, as two parts never draw the same samples.
Curve Line(const Eigen::Vector3d& from,
           const Eigen::Vector3d& to,
           double shift = 0) {
  Curve curve;
  const Eigen::Vector3d tangent = (to - from).normalized();
  for (double s = shift; s <= (to - from).norm(); ++s) {
    CurveSample& sample = curve.samples.emplace_back();
    sample.position = kPx * (from + s * tangent);
    sample.tangent = tangent;
  }
  return curve;
}

Curve Circle(double center_x, double radius, double first_rad) {
  Curve curve;
  curve.closed = true;
  const int num_samples = static_cast<int>(2 * kPi * radius);
  for (int i = 0; i < num_samples; ++i) {
    const double a = first_rad + 2 * kPi * i / num_samples;
    CurveSample& sample = curve.samples.emplace_back();
    sample.position =
        kPx * Eigen::Vector3d(
                  center_x + radius * std::cos(a), radius * std::sin(a), 0);
    sample.tangent = {-std::sin(a), std::cos(a), 0};
  }
  return curve;
}

// What each part has drawn, cut to what it gives.
Curves Join(const Curves& below, const Curves& above) {
  const ScenePartition partition = Halves();
  const auto cores = CoresOf(partition);
  return JoinCurvesOfParts(partition,
                           {CutCurves(below, cores[0], partition.overlap),
                            CutCurves(above, cores[1], partition.overlap)},
                           Views(),
                           Options());
}

void ExpectEvenSteps(const Curve& curve) {
  for (std::size_t k = 1; k < curve.samples.size(); ++k) {
    const Eigen::Vector3d step =
        curve.samples[k].position - curve.samples[k - 1].position;
    EXPECT_GT(step.norm(), 0.4 * kPx);
    EXPECT_LT(step.norm(), 2.1 * kPx);
    EXPECT_GT(step.dot(curve.samples[k].tangent), 0) << "sample " << k;
  }
}

TEST(JoinCurvesOfParts, MakesALineAcrossTheBorderWhole) {
  for (const double shift : {0.0, 0.3, 0.7}) {
    for (const bool is_reversed : {false, true}) {
      const Curve above = is_reversed
                              ? Line({90, 0.2, 0}, {-60, 0.2, 0}, shift)
                              : Line({-60, 0.2, 0}, {90, 0.2, 0}, shift);
      const Curves joined = Join({Line({-100, 0, 0}, {70, 0, 0})}, {above});
      ASSERT_EQ(joined.size(), 1u);
      EXPECT_NEAR(Length(joined[0]), 190 * kPx, 2 * kPx);
      ExpectEvenSteps(joined[0]);
    }
  }
}

TEST(JoinCurvesOfParts, DrawsALineAlongTheBorderOnce) {
  for (const double x : {-0.4, 0.0, 0.4}) {
    // Each part sees it a little on the other's side, or on its own.
    for (const double error : {-0.2, 0.2}) {
      const Curves joined =
          Join({Line({x + error, -50, 0}, {x + error, 50, 0})},
               {Line({x - error, -50, 0}, {x - error, 50, 0}, 0.4)});
      ASSERT_EQ(joined.size(), 1u) << x << " " << error;
      EXPECT_NEAR(Length(joined[0]), 100 * kPx, 2 * kPx);
      ExpectEvenSteps(joined[0]);
    }
  }
}

TEST(JoinCurvesOfParts, FollowsALineThatHugsTheBorder) {
  const Curves joined = Join({Line({-2, -80, 0}, {2, 80, 0})},
                             {Line({-2.1, -80, 0}, {2.1, 80, 0}, 0.5)});
  ASSERT_EQ(joined.size(), 1u);
  EXPECT_NEAR(Length(joined[0]), 160 * kPx, 2.5 * kPx);
}

TEST(JoinCurvesOfParts, ClosesARingAcrossTheBorder) {
  for (const double center_x : {0.0, 25.0}) {
    const Curves joined =
        Join({Circle(center_x, 40, 0.1)}, {Circle(center_x, 40, 2.5)});
    ASSERT_EQ(joined.size(), 1u);
    EXPECT_TRUE(joined[0].closed);
    EXPECT_NEAR(Length(joined[0]), 2 * kPi * 40 * kPx, 3 * kPx);
  }
}

TEST(JoinCurvesOfParts, LeavesWhatLiesInOneCoreAsItIs) {
  const Curve line = Line({-90, 0, 0}, {-40, 0, 0});
  const Curve circle = Circle(70, 20, 0);
  const Curves joined = Join({line}, {circle});
  ASSERT_EQ(joined.size(), 2u);
  EXPECT_EQ(joined[0].samples.size(), line.samples.size());
  EXPECT_EQ(joined[0].samples[7].position, line.samples[7].position);
  EXPECT_TRUE(joined[1].closed);
  EXPECT_EQ(joined[1].samples[9].position, circle.samples[9].position);
}

TEST(JoinCurvesOfParts, KeepsWhatOnlyOnePartHasDrawnNearTheBorder) {
  const Curves joined = Join({Line({-40, 0, 0}, {15, 0, 0})}, {});
  ASSERT_EQ(joined.size(), 1u);
  EXPECT_NEAR(Length(joined[0]), 55 * kPx, kPx);
}

TEST(JoinCurvesOfParts, DropsAStubThatGoesOnNowhere) {
  EXPECT_TRUE(Join({Line({20, 0, 0}, {60, 0, 0})}, {}).empty());
}

TEST(JoinCurvesOfParts, LeavesParallelLinesApart) {
  const Curves both = {Line({-50, 0, 0}, {50, 0, 0}),
                       Line({-50, 4, 0}, {50, 4, 0})};
  const Curves joined = Join(both, both);
  ASSERT_EQ(joined.size(), 2u);
  EXPECT_NEAR(Length(joined[0]), 100 * kPx, 2 * kPx);
  EXPECT_NEAR(Length(joined[1]), 100 * kPx, 2 * kPx);
}

TEST(JoinCurvesOfParts, LeavesCurvesThatCrossOnTheBorderApart) {
  const Curves both = {Line({-50, -50, 0}, {50, 50, 0}),
                       Line({-50, 50, 0}, {50, -50, 0})};
  const Curves joined = Join(both, both);
  ASSERT_EQ(joined.size(), 2u);
  for (const Curve& curve : joined) ExpectEvenSteps(curve);
}

}  // namespace
}  // namespace curvix
