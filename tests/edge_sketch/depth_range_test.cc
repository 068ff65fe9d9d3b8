// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/view_overlap.h"

#include <gtest/gtest.h>
#include <cmath>
#include <vector>

#include "tests/support/test_views.h"

namespace curvix {
namespace {

// Two views that look along z; the second stands 1 behind the first.
std::vector<PosedView> TwoViews() {
  const Eigen::Matrix3d ahead = Eigen::Matrix3d::Identity();
  return {MakeView(ahead, {0, 0, 0}), MakeView(ahead, {0, 0, -1})};
}

ScenePoint PointAt(double depth, std::vector<int> view_idxs) {
  return {{0.1, 0.2, depth}, std::move(view_idxs), {}};
}

// Inverse depths 0.2 to 0.4, seen by both views, and wrong ones on either side.
std::vector<ScenePoint> Points() {
  std::vector<ScenePoint> points;
  for (int i = 0; i <= 20; ++i) {
    points.push_back(PointAt(1 / (0.2 + 0.01 * i), {0, 1}));
  }
  for (const double wrong : {0.01, 0.02, 500.0, 1000.0}) {
    points.push_back(PointAt(wrong, {0, 1}));
  }
  return points;
}

TEST(FindDepthRanges, WidensTheRangeOfInverseDepthsOfEachView) {
  const auto ranges = FindDepthRanges(TwoViews(), Points(), 0.25);
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_NEAR(ranges[0].nearest, 1 / 0.45, 1e-9);
  EXPECT_NEAR(ranges[0].farthest, 1 / 0.15, 1e-9);
  const double least = 1 / 6.0, most = 1 / 3.5;
  const double beyond = 0.25 * (most - least);
  EXPECT_NEAR(ranges[1].nearest, 1 / (most + beyond), 1e-9);
  EXPECT_NEAR(ranges[1].farthest, 1 / (least - beyond), 1e-9);
}

TEST(FindDepthRanges, ReachesInfinityWhereTheMarginDoes) {
  EXPECT_TRUE(std::isinf(FindDepthRanges(TwoViews(), Points(), 1)[0].farthest));
}

TEST(FindDepthRanges, LeavesAFlatSceneSomeDepth) {
  const std::vector<ScenePoint> flat(30, PointAt(2, {0}));
  const DepthRange range = FindDepthRanges(TwoViews(), flat, 0.5)[0];
  EXPECT_NEAR(range.nearest, 2 / 1.1, 1e-9);
  EXPECT_NEAR(range.farthest, 2 / 0.9, 1e-9);
}

TEST(FindDepthRanges, BoundsNothingWithoutPointsOrMargin) {
  std::vector<ScenePoint> few = Points();
  few.resize(15);
  const std::vector<ScenePoint> behind(30, PointAt(-2, {0, 1}));
  for (const auto& ranges : {FindDepthRanges(TwoViews(), {}, 0.5),
                             FindDepthRanges(TwoViews(), few, 0.5),
                             FindDepthRanges(TwoViews(), behind, 0.5),
                             FindDepthRanges(TwoViews(), Points(), 0)}) {
    ASSERT_EQ(ranges.size(), 2u);
    for (const DepthRange& range : ranges) {
      EXPECT_EQ(range.nearest, 0);
      EXPECT_TRUE(std::isinf(range.farthest));
    }
  }
}

}  // namespace
}  // namespace curvix
