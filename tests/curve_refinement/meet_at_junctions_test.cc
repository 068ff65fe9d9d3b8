// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/refine_curves.h"

#include <gtest/gtest.h>

#include "base/angles.h"
#include "model/curve_chains.h"
#include "tests/curve_refinement/drawn_curves.h"

namespace curvix {
namespace {

constexpr CurveRefinementOptions kMeetOptions = {.junction_reach_px = 10};

std::vector<Curve> Meet(const std::vector<Curve>& curves,
                        const std::vector<PosedView>& views = FrontalViews(),
                        const CurveRefinementOptions& options = kMeetOptions) {
  return MeetAtJunctions(curves, {views, {}, kEdgeSigmaPx, options, 1});
}

// From `gap_px` to 60 px away from `corner`.
Curve Edge(const Eigen::Vector3d& corner,
           const Eigen::Vector3d& direction,
           double gap_px) {
  const Eigen::Vector3d unit = direction.normalized();
  return Line(corner + gap_px * kPixel * unit, corner + 60 * kPixel * unit);
}

// Two edges at `angle_deg` whose ends are `gap_px` from their corner.
std::vector<Curve> Corner(double angle_deg, double gap_px) {
  const double angle = angle_deg * std::numbers::pi / 180;
  return {Edge({0, 0, 0}, {1, 0, 0}, gap_px),
          Edge({0, 0, 0}, {std::cos(angle), 0, std::sin(angle)}, gap_px)};
}

TEST(MeetAtJunctions, ThreeLinesEndInOnePointAndStayStraight) {
  const Eigen::Vector3d corner(0.013, 0.02, -0.031);
  const std::vector<Eigen::Vector3d> directions = {
      {1, 0, 0}, {0.2, 1, 0.3}, {-0.3, 0.1, 1}};
  std::vector<Curve> curves;
  for (const Eigen::Vector3d& direction : directions) {
    curves.push_back(Edge(corner, direction, 4));
  }
  curves[1] = Reversed(curves[1]);
  const std::vector<Curve> met = Meet(curves);
  const Eigen::Vector3d junction = met[0].samples.front().position;
  EXPECT_EQ(met[1].samples.back().position, junction);
  EXPECT_EQ(met[2].samples.front().position, junction);
  EXPECT_LT((junction - corner).norm(), 1e-9);
  for (std::size_t i = 0; i < met.size(); ++i) {
    const Eigen::Vector3d along =
        (i == 1 ? -1 : 1) * directions[i].normalized();
    EXPECT_GT(met[i].samples.size(), 50u);
    for (std::size_t k = 0; k < met[i].samples.size(); ++k) {
      const CurveSample& sample = met[i].samples[k];
      EXPECT_LT((sample.position - corner).cross(along).norm(), 1e-9);
      EXPECT_LT((sample.tangent - along).norm(), 1e-9);
      if (k == 0) continue;
      const Eigen::Vector3d step =
          sample.position - met[i].samples[k - 1].position;
      EXPECT_GT(step.dot(along), 0);
    }
  }
}

TEST(MeetAtJunctions, CutsOffWhatTheCornerHasBent) {
  std::vector<Curve> curves = Corner(90, 1);
  for (Curve& curve : curves) {
    for (std::size_t k = 0; k < 2; ++k)
      curve.samples[k].position += InPlane(0.4, 0.4);
  }
  const std::vector<Curve> met = Meet(curves);
  for (const CurveSample& sample : met[0].samples) {
    EXPECT_NEAR(sample.position.z(), 0, 1e-9);
  }
  EXPECT_LT(met[0].samples.front().position.norm(), 1e-9);
  EXPECT_EQ(met[1].samples.front().position, met[0].samples.front().position);
}

// The ends of a small circle, a piece of which is missing, make no spike.
TEST(MeetAtJunctions, LeavesTheEndsOfSmallCircles) {
  for (const double radius_px : {4.5, 5.0, 6.0, 7.0}) {
    for (const double gap : {0.2, 0.4, 0.8}) {
      const Curve circle = Arc(radius_px, gap / 2, 2 * kPi - gap / 2);
      const std::vector<Curve> met = Meet({circle});
      ASSERT_EQ(met.size(), 1u);
      for (const CurveSample& sample : met[0].samples) {
        EXPECT_NEAR(sample.position.norm() / kPixel, radius_px, 0.3)
            << radius_px << " " << gap;
      }
    }
  }
}

TEST(MeetAtJunctions, NoEdgeSupportsWhatIsAdded) {
  std::vector<Curve> curves = Corner(90, 4);
  for (Curve& curve : curves) {
    for (std::size_t k = 0; k < curve.samples.size(); ++k) {
      curve.samples[k].support = {{0, static_cast<std::int32_t>(k)}};
    }
  }
  for (const Curve& curve : Meet(curves)) {
    for (const CurveSample& sample : curve.samples) {
      const double from_corner_px = sample.position.norm() / kPixel;
      if (from_corner_px > 3 && from_corner_px < 10) continue;
      EXPECT_EQ(sample.support.empty(), from_corner_px < 5);
    }
  }
}

// Both its ends could go on to the corner.
TEST(MeetAtJunctions, AShortCurveDoesNotTurnBack) {
  std::vector<Curve> curves = Corner(90, 4);
  const Eigen::Vector3d way = Eigen::Vector3d(1, 0, 1).normalized();
  curves.push_back(Line(0.5 * kPixel * way, 6.5 * kPixel * way));
  const Curve met = Meet(curves)[2];
  EXPECT_NE(met.samples.front().position, met.samples.back().position);
}

TEST(MeetAtJunctions, EndsOutOfReachStay) {
  EXPECT_GT(LargestDistance(Meet(Corner(90, 9)), Corner(90, 9)), 0);
  EXPECT_EQ(LargestDistance(Meet(Corner(90, 11)), Corner(90, 11)), 0);
}

TEST(MeetAtJunctions, LinesThatPassEachOtherStay) {
  for (const double apart_px : {2.6, 3.4}) {  // limit: 1.5 px to the middle
    std::vector<Curve> curves = Corner(90, 4);
    for (CurveSample& sample : curves[1].samples) {
      sample.position.y() += apart_px * kPixel;
    }
    EXPECT_EQ(LargestDistance(Meet(curves), curves) == 0, apart_px > 3)
        << apart_px;
  }
}

TEST(MeetAtJunctions, LinesThatRunSideBySideStay) {
  EXPECT_GT(LargestDistance(Meet(Corner(25, 4)), Corner(25, 4)), 0);
  EXPECT_EQ(LargestDistance(Meet(Corner(8, 4)), Corner(8, 4)), 0);
}

TEST(MeetAtJunctions, ClosedCurvesAndShortOnesStay) {
  std::vector<Curve> curves = Corner(90, 4);
  curves[0].closed = true;
  EXPECT_EQ(LargestDistance(Meet(curves), curves), 0);
  curves = Corner(90, 4);
  curves[0].samples.resize(4);
  EXPECT_EQ(LargestDistance(Meet(curves), curves), 0);
  EXPECT_TRUE(Meet({}).empty());
}

TEST(MeetAtJunctions, NoReachChangesNothing) {
  CurveRefinementOptions options = kMeetOptions;
  options.junction_reach_px = 0;
  EXPECT_EQ(LargestDistance(Meet(Corner(90, 4), FrontalViews(), options),
                            Corner(90, 4)),
            0);
}

TEST(MeetAtJunctions, DoesNotDependOnTheUnit) {
  const double factor = 1000;
  const std::vector<Curve> curves = Corner(70, 5);
  const std::vector<Curve> met =
      Meet(Scaled(curves, factor), Scaled(FrontalViews(), factor));
  EXPECT_LT(LargestDistance(met, Scaled(Meet(curves), factor)), 1e-9 * factor);
}

}  // namespace
}  // namespace curvix
