// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/view_overlap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/angles.h"
#include "tests/support/random.h"
#include "tests/support/synthetic_edges.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::optional<ViewOverlap> OverlapOf(const Overlaps& overlaps, int i, int j) {
  for (const ViewOverlap& overlap : overlaps[static_cast<std::size_t>(i)]) {
    if (overlap.other == j) return overlap;
  }
  return std::nullopt;
}

// Points in a ball of radius 1 around `center`, seen by all views.
std::vector<ScenePoint> Ball(const Vector3d& center,
                             std::size_t num_views,
                             int count) {
  Random random(1);
  std::vector<ScenePoint> points(static_cast<std::size_t>(count));
  for (ScenePoint& point : points) {
    const double radius = random.Uniform();
    point.position = center + radius * random.UnitVector();
    for (std::size_t v = 0; v < num_views; ++v) {
      point.view_idxs.push_back(static_cast<int>(v));
    }
  }
  return points;
}

TEST(FindOverlaps, KnowsTheAnglesOfARingWithAndWithoutPoints) {
  const auto views = RingOfViews(12);
  for (const auto& points :
       {std::vector<ScenePoint>(), Ball({0, 0, 0}, views.size(), 200)}) {
    const auto overlaps = FindOverlaps(views, points);
    ASSERT_EQ(overlaps.size(), views.size());
    for (int i = 0; i < 12; ++i) {
      for (int j = 0; j < 12; ++j) {
        const auto overlap = OverlapOf(overlaps, i, j);
        ASSERT_EQ(overlap.has_value(), i != j);
        if (!overlap) continue;
        const Vector3d& a = views[static_cast<std::size_t>(i)].center;
        const Vector3d& b = views[static_cast<std::size_t>(j)].center;
        const double angle = std::acos(a.normalized().dot(b.normalized()));
        EXPECT_NEAR(RadToDeg(overlap->ray_angle_rad), RadToDeg(angle), 6);
        EXPECT_GT(overlap->share, 0.9);
        EXPECT_NEAR(overlap->baseline_across.norm(), 1, 1e-12);
        EXPECT_NEAR(overlap->baseline_across.dot(a.normalized()), 0, 1e-12);
      }
    }
  }
}

TEST(FindOverlaps, ListsOthersInOrder) {
  for (const auto& others : FindOverlaps(RingOfViews(7), {})) {
    EXPECT_TRUE(std::is_sorted(others.begin(),
                               others.end(),
                               [](const ViewOverlap& a, const ViewOverlap& b) {
                                 return a.other < b.other;
                               }));
  }
}

TEST(FindOverlaps, TakesParallelCamerasForARowAlongAnObject) {
  std::vector<PosedView> views;
  for (int i = 0; i < 6; ++i) {
    views.push_back(MakeView(Matrix3d::Identity(), {0.5 * i, 0, 0}));
  }
  // A second photograph from the same place says nothing about depth.
  views.push_back(views.front());
  const auto overlaps = FindOverlaps(views, {});
  const auto next = OverlapOf(overlaps, 0, 1);
  ASSERT_TRUE(next);
  EXPECT_GT(next->share, 0.5);
  EXPECT_NEAR(RadToDeg(next->ray_angle_rad), RadToDeg(std::atan(0.2)), 1.5);
  EXPECT_LT((next->baseline_across - Vector3d(1, 0, 0)).norm(), 1e-12);
}

TEST(FindOverlaps, BelievesPointsRatherThanGuesses) {
  std::vector<PosedView> views;
  for (int i = 0; i < 4; ++i) {
    views.push_back(MakeView(Matrix3d::Identity(), {0.5 * i, 0, 0}));
  }
  const auto overlaps =
      FindOverlaps(views, Ball({0.75, 0, 20}, views.size(), 100));
  EXPECT_NEAR(OverlapOf(overlaps, 0, 1)->ray_angle_rad, 0.5 / 20, 0.003);
  EXPECT_EQ(OverlapOf(overlaps, 0, 1)->share, 1);
}

TEST(FindOverlaps, DoesNotRelyOnAHandfulOfPoints) {
  const auto views = RingOfViews(8);
  const auto without = FindOverlaps(views, {});
  const auto with = FindOverlaps(views, Ball({50, 50, 50}, views.size(), 7));
  for (int j = 1; j < 8; ++j) {
    EXPECT_EQ(OverlapOf(with, 0, j)->ray_angle_rad,
              OverlapOf(without, 0, j)->ray_angle_rad);
  }
}

TEST(FindOverlaps, HasOverlapInForwardMotion) {
  std::vector<PosedView> views;
  for (int i = 0; i < 4; ++i) {
    views.push_back(MakeView(Matrix3d::Identity(), {0, 0, 1.0 * i}));
  }
  const auto overlaps = FindOverlaps(views, Ball({0, 0, 8}, views.size(), 100));
  const auto overlap = OverlapOf(overlaps, 0, 3);
  ASSERT_TRUE(overlap);
  EXPECT_EQ(overlap->share, 1);
  EXPECT_GT(overlap->ray_angle_rad, 0);
  EXPECT_EQ(overlap->baseline_across, Vector3d::Zero());
}

TEST(FindOverlaps, FindsNoneWhereTheCameraOnlyTurned) {
  for (const Vector3d& center : {Vector3d(0, 0, 0), Vector3d(1e3, -2e3, 7)}) {
    std::vector<PosedView> views;
    for (int i = 0; i < 6; ++i) {
      const Eigen::AngleAxisd turn(0.1 * i, Vector3d(0.1, 1, 0).normalized());
      views.push_back(MakeView(turn.matrix(), center));
      // As it comes out of a pose, with rounding errors.
      views.back().center =
          -(views.back().rotation.transpose() * views.back().translation);
    }
    const auto overlaps = FindOverlaps(views, {});
    ASSERT_EQ(overlaps.size(), views.size());
    for (const auto& others : overlaps) EXPECT_TRUE(others.empty());
  }
}

// A ring of views, and after them `num_frames` frames next to view 0, each a
// tenth of a degree on.
std::vector<PosedView> RingAndFrames(int num_views, int num_frames) {
  std::vector<PosedView> views = RingOfViews(num_views);
  for (int i = 1; i <= num_frames; ++i) {
    const Eigen::AngleAxisd turn(DegToRad(0.1 * i), Vector3d::UnitZ());
    views.push_back(LookAt(turn * views.front().center, {0, 0, 0}));
  }
  return views;
}

// Of views that all have as many edges.
DistinctViews Distinct(const std::vector<PosedView>& views,
                       const std::vector<ScenePoint>& points = {},
                       const Options& options = {}) {
  std::vector<EdgeMap> edge_maps(views.size());
  for (EdgeMap& map : edge_maps) map.edges.resize(5);
  return FindDistinctViews(views, edge_maps, points, options);
}

std::vector<std::size_t> Repeated(const DistinctViews& distinct) {
  std::vector<std::size_t> repeated;
  for (std::size_t i = 0; i < distinct.are_repeated.size(); ++i) {
    if (distinct.are_repeated[i]) repeated.push_back(i);
  }
  return repeated;
}

TEST(FindDistinctViews, OneOfSeveralFramesRemains) {
  const std::vector<PosedView> views = RingAndFrames(12, 3);
  std::vector<ScenePoint> points = Ball({0, 0, 0}, views.size(), 50);
  EXPECT_THAT(Repeated(Distinct(views)), ElementsAre(12, 13, 14));
  EXPECT_THAT(Repeated(Distinct(views, points)), ElementsAre(12, 13, 14));
  // More points are seen sharply in frame 13.
  for (std::size_t i = 0; i < points.size(); i += 5) points[i].view_idxs = {13};
  const DistinctViews distinct = Distinct(views, points);
  EXPECT_THAT(Repeated(distinct), ElementsAre(0, 12, 14));
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::vector<ViewOverlap>& others = distinct.overlaps[i];
    EXPECT_EQ(others.size(), distinct.are_repeated[i] ? 0 : 11) << i;
    for (const ViewOverlap& overlap : others) {
      EXPECT_FALSE(
          distinct.are_repeated[static_cast<std::size_t>(overlap.other)]);
    }
  }
}

TEST(FindDistinctViews, OneOfEqualViewsRemains) {
  const std::vector<PosedView> views(4, RingOfViews(8)[3]);
  EXPECT_THAT(Repeated(Distinct(views)), ElementsAre(1, 2, 3));
  EXPECT_TRUE(Distinct({}).overlaps.empty());
}

// A view is left out by one that remains, not by one that is left out.
TEST(FindDistinctViews, RepetitionDoesNotPropagate) {
  const std::vector<PosedView> ring = RingAndFrames(1, 8);
  const std::vector<ScenePoint> points = Ball({0, 0, 0}, 3, 50);
  EXPECT_THAT(Repeated(Distinct({ring[0], ring[4], ring[8]}, points)),
              ElementsAre(1));
  EXPECT_THAT(Repeated(Distinct({ring[4], ring[0], ring[8]}, points)),
              ElementsAre(1, 2));
}

TEST(FindDistinctViews, AViewWithoutEdgesLeavesOutNone) {
  const std::vector<PosedView> views = RingAndFrames(6, 2);
  std::vector<EdgeMap> edge_maps(views.size());
  for (std::size_t i = 1; i < 7; ++i) edge_maps[i].edges.resize(3);
  edge_maps[7].edges.resize(4);
  const auto repeated = [&](const Options& options) {
    return Repeated(FindDistinctViews(views, edge_maps, {}, options));
  };
  EXPECT_THAT(repeated({}), ElementsAre(0, 6)) << "7 has most edges";
  edge_maps[6].edges.clear();
  edge_maps[7].edges.clear();
  EXPECT_THAT(repeated({}), IsEmpty()) << "no frame has edges";
}

TEST(FindDistinctViews, AreAllAtZeroDegreesAndInPairs) {
  std::vector<PosedView> views = RingAndFrames(5, 2);
  views.push_back(views.front());
  Options zero;
  zero.validation.min_view_angle_deg = 0;
  Options pairs;
  pairs.hypotheses.view_selection = ViewSelection::kUnusedEdges;
  for (const Options& options : {zero, pairs}) {
    const DistinctViews distinct = Distinct(views, {}, options);
    EXPECT_THAT(Repeated(distinct), IsEmpty());
    EXPECT_EQ(distinct.overlaps[0].size(), 6u) << "not with its copy";
    EXPECT_EQ(distinct.overlaps[1].size(), 7u);
  }
}

TEST(FindDistinctViews, WhatShowsMoreOrLessRemainsButDoesNotOverlap) {
  std::vector<PosedView> views = RingOfViews(8);
  // From the same place: another direction, and a much longer lens.
  views.push_back(LookAt(views[0].center, {2.5, 2.5, 0}));
  views.push_back(views[0]);
  views.back().calibration.topLeftCorner<2, 2>() *= 10;
  const DistinctViews distinct =
      Distinct(views, Ball({0, 0, 0}, views.size(), 100));
  EXPECT_THAT(Repeated(distinct), IsEmpty());
  for (const int other : {8, 9}) {
    EXPECT_FALSE(OverlapWith(distinct.overlaps[0], other)) << other;
    EXPECT_TRUE(OverlapWith(distinct.overlaps[3], other)) << other;
  }
}

// Views 0 to 7 on a ring, and at the place of view 0, 0.3 degrees on and 0.3
// degrees further one that looks aside (8 to 10), and one with a longer lens
// (11).
std::vector<PosedView> RingAndTurned() {
  std::vector<PosedView> views = RingOfViews(8);
  for (const double degrees : {0.0, 0.3, 0.6}) {
    const Eigen::AngleAxisd turn(DegToRad(degrees), Vector3d::UnitZ());
    views.push_back(LookAt(turn * views[0].center, {2, 2, 0}));
  }
  views.push_back(views[0]);
  views.back().calibration.topLeftCorner<2, 2>() *= 10;
  return views;
}

TEST(FindDistinctViews, ViewsFromOnePlaceAreAStation) {
  const DistinctViews distinct = Distinct(RingAndTurned());
  EXPECT_THAT(Repeated(distinct), ElementsAre(9));
  // 0.6 degrees on is another station.
  EXPECT_THAT(distinct.stations,
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 0, 9, 10, 0));
  EXPECT_THAT(distinct.before_at_station[0], IsEmpty());
  EXPECT_THAT(distinct.before_at_station[8], ElementsAre(0));
  EXPECT_THAT(distinct.before_at_station[11], ElementsAre(0, 8));
  EXPECT_THAT(distinct.before_at_station[1], IsEmpty());
}

TEST(FindDistinctViews, EachViewIsAStationAtZeroDegrees) {
  Options zero;
  zero.validation.min_view_angle_deg = 0;
  const DistinctViews distinct = Distinct(RingAndTurned(), {}, zero);
  EXPECT_THAT(distinct.stations,
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));
  EXPECT_THAT(distinct.before_at_station, Each(IsEmpty()));
}

TEST(FindOverlaps, FindsNoneBetweenViewsThatLookAwayFromEachOther) {
  const std::vector<PosedView> views = {LookAt({1, 0, 0}, {5, 0, 0}),
                                        LookAt({-1, 0, 0}, {-5, 0, 0})};
  for (const auto& others : FindOverlaps(views, {})) {
    EXPECT_TRUE(others.empty());
  }
}

TEST(FindOverlaps, FindsAllViewsThatSeeAPlaceAndNoOthers) {
  Random random(5);
  std::vector<PosedView> views;
  for (int i = 0; i < 150; ++i) {
    const Vector3d center(0.3 * i, 0.2 * random.Uniform(), 0);
    views.push_back(LookAt(
        center,
        center + Vector3d(random.Uniform() - 0.5, random.Uniform() - 0.5, 3)));
  }
  const auto places = FindPlaces(views, {});
  const auto overlaps = FindOverlaps(views, {});
  std::size_t num_overlaps = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t j = 0; j < views.size(); ++j) {
      const bool is_seen = std::any_of(
          places[i].begin(), places[i].end(), [&](const Vector3d& place) {
            const Vector3d x = views[j].InCamera(place);
            return x.z() > 0 && views[j].Contains(views[j].Pixel(x));
          });
      const bool overlap =
          OverlapOf(overlaps, static_cast<int>(i), static_cast<int>(j))
              .has_value();
      EXPECT_EQ(overlap, is_seen && i != j) << i << " " << j;
      num_overlaps += overlap;
    }
  }
  EXPECT_GT(num_overlaps, 4 * views.size());
  EXPECT_LT(num_overlaps, views.size() * views.size() * 2 / 3);
}

TEST(FindPlaces, GuessesTheDepthByTheCamerasAround) {
  // Two objects far apart, one twice as far from the cameras round it.
  std::vector<PosedView> views;
  for (const double radius : {2.0, 4.0}) {
    const Vector3d center(100 * radius, 0, 0);
    for (int i = 0; i < 100; ++i) {
      const double angle = 2 * kPi * i / 100;
      views.push_back(LookAt(
          center + radius * Vector3d(std::cos(angle), std::sin(angle), 0.3),
          center));
    }
  }
  const auto places = FindPlaces(views, {});
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double distance = (places[i][4] - views[i].center).norm();
    const double expected = (i < 100 ? 2.0 : 4.0) * std::hypot(1, 0.3);
    EXPECT_NEAR(distance, expected, 0.1 * expected) << i;
  }
}

TEST(FindOverlaps, TakesASingleViewAndNone) {
  EXPECT_TRUE(FindOverlaps({}, {}).empty());
  EXPECT_TRUE(FindOverlaps(RingOfViews(1), {}).front().empty());
}

}  // namespace
}  // namespace curvix
