// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/visible_side.h"

#include <gtest/gtest.h>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/angles.h"
#include "edge_sketch/view_index.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

const SpaceEdge kEdge = {Vector3d(1, 2, 3), Vector3d::UnitZ()};

// Views at some angles about the edge, of which nothing but the place matters.
class Views {
 public:
  explicit Views(const std::vector<double>& angles_deg)
      : posed_(angles_deg.size()), maps_(angles_deg.size()) {
    for (std::size_t i = 0; i < angles_deg.size(); ++i) {
      const double angle = DegToRad(angles_deg[i]);
      // At several heights, which make no difference.
      posed_[i].center = kEdge.position + Vector3d(5 * std::cos(angle),
                                                   5 * std::sin(angle),
                                                   static_cast<double>(i % 3));
      posed_[i].width = posed_[i].height = 10;
    }
    indices_ =
        IndexViews(posed_, maps_, AllDistinct(Overlaps(posed_.size())), 1);
  }

  // Without neighbours, unless given.
  VisibleSide Find(const std::vector<double>& logs,
                   NeighborsByView neighbors = {}) const {
    neighbors.resize(logs.size());
    const double without = std::exp(LogLikelihoodRatio(VoteWithoutSupport()));
    Votes votes;
    for (const double log : logs)
      votes.push_back(Vote{std::exp(log) - without});
    return FindVisibleSide(kEdge, votes, neighbors, indices_);
  }
  bool IsSeenBy(std::size_t i, const VisibleSide& side) const {
    return IsInFront(posed_[i].center, kEdge, side.facing);
  }

 private:
  std::vector<PosedView> posed_;
  std::vector<EdgeMap> maps_;
  std::vector<ViewIndex> indices_;
};

const std::vector<double> kAround = {0, 45, 90, 135, 180, 225, 270, 315};

// Each view is next to those 45 degrees away.
NeighborsByView NextAround(double weight) {
  NeighborsByView neighbors(kAround.size());
  for (int i = 0; i < 8; ++i) {
    neighbors[static_cast<std::size_t>(i)] = {{(i + 1) % 8, weight},
                                              {(i + 7) % 8, weight}};
  }
  return neighbors;
}

TEST(FindVisibleSide, IsAllAroundIfAllViewsAgree) {
  const VisibleSide side =
      Views(kAround).Find(std::vector<double>(kAround.size(), 3));
  EXPECT_FALSE(side.facing);
  EXPECT_DOUBLE_EQ(side.evidence, 8 * 3 + std::log(0.5));
}

TEST(FindVisibleSide, FacesTheViewsThatShowTheEdge) {
  const Views views(kAround);
  const VisibleSide side =
      views.Find({4, 4, 4, 4, -2, -2, -2, -2}, NextAround(0.9));
  ASSERT_TRUE(side.facing);
  for (std::size_t i = 0; i < kAround.size(); ++i) {
    EXPECT_EQ(views.IsSeenBy(i, side), i < 4) << i;
  }
  // One half turn out of eight, which half of all edges show.
  EXPECT_NEAR(side.evidence, 4 * 4 + std::log(0.5 / 8), 1e-9);
  // In the middle of the angles from which these four are in front.
  EXPECT_NEAR(side.facing->x(), std::cos(DegToRad(67.5)), 1e-9);
  EXPECT_NEAR(side.facing->y(), std::sin(DegToRad(67.5)), 1e-9);
  EXPECT_NEAR(side.facing->z(), 0, 1e-9);
}

TEST(FindVisibleSide, DoesNotPartViewsThatSeeTheSame) {
  // The third view is so near to the second that it would be in front, too.
  const Views views({0, 40, 41, 80});
  const auto next = [](int a, int b) {
    return std::vector<ViewNeighbor>{{a, 0.9}, {b, 0.9}};
  };
  const VisibleSide side = views.Find(
      {2, 2, -2, -2}, {next(1, 2), next(0, 2), next(1, 3), next(1, 2)});
  EXPECT_FALSE(side.facing);
}

TEST(FindVisibleSide, IsNeverNegative) {
  EXPECT_EQ(Views(kAround).Find(std::vector<double>(8, -2)).evidence, 0);
  EXPECT_EQ(Views({}).Find({}).evidence, 0);
}

TEST(FindVisibleSide, DoesNotDependOnTheOrderOfViews) {
  const std::vector<double> angles = {10, 70, 160, 200, 290};
  const std::vector<double> votes = {3, 5, 4, -2, -2};
  const VisibleSide side = Views(angles).Find(votes);
  const VisibleSide reversed = Views({angles.rbegin(), angles.rend()})
                                   .Find({votes.rbegin(), votes.rend()});
  EXPECT_NEAR(side.evidence, reversed.evidence, 1e-9);
  EXPECT_EQ(side.facing.has_value(), reversed.facing.has_value());
}

TEST(IsInFront, FollowsTheTangentOfACurve) {
  // The top of a disc, and places on its rim.
  const Vector3d facing = Vector3d::UnitZ();
  for (const double angle : {0.0, 1.0, 2.0, 4.0}) {
    const SpaceEdge rim = {Vector3d(std::cos(angle), std::sin(angle), 0),
                           Vector3d(-std::sin(angle), std::cos(angle), 0)};
    EXPECT_TRUE(IsInFront(Vector3d(3, 1, 0.5), rim, facing));
    EXPECT_FALSE(IsInFront(Vector3d(3, 1, -0.5), rim, facing));
  }
  EXPECT_TRUE(IsInFront(Vector3d(3, 1, -0.5), kEdge, std::nullopt));
}

}  // namespace
}  // namespace curvix
