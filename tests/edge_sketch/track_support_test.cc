// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/track_support.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

#include "geometry/detected_edge.h"
#include "tests/support/random.h"
#include "tests/support/synthetic_edges.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSigmaPx = 0.15;

// A tilted line and a circle apart from it, in 16 views.
// Those of the hypothesis, 0 and 2, and the views next to them.
const std::vector<std::int32_t> kFirstViews = {1, 3, 15, 0, 2};

std::vector<std::int32_t> AllViews() {
  std::vector<std::int32_t> all(16);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

class TrackSupportTest : public ::testing::Test {
 protected:
  explicit TrackSupportTest(double noise_px = 0)
      : views_(RingOfViews(16)), maps_(ExactEdgeMaps(curves_, views_, 1)) {
    Random random(2);
    for (EdgeMap& map : maps_) {
      for (Edge2d& edge : map.edges) {
        const Vector2d t = ToImageEdge(edge).tangent;
        edge.position += noise_px * random.Normal() * Vector2d(-t.y(), t.x());
      }
    }
    for (std::size_t i = 0; i < views_.size(); ++i) {
      ViewIndex& index = indices_.emplace_back();
      index.view = &views_[i];
      index.edges = &maps_[i];
      index.grid = GridIndex(maps_[i].edges, 4);
      index.density = EdgeDensity(maps_[i], 800, 800);
      const int before = static_cast<int>((i + 15) % 16);
      const int after = static_cast<int>((i + 1) % 16);
      neighbors_.push_back({{before, 0.7}, {after, 0.7}});
    }
  }

  // What views 0 and 2 tell about a place of a curve, moved by `depth` along
  // the ray of view 0.
  EdgeEstimate Start(const TestCurve& curve, double s, double depth) const {
    const SpaceEdge truth{curve.position(s), curve.tangent(s)};
    SpaceEdge start = truth;
    start.position += depth * (truth.position - views_[0].center).normalized();
    const auto measure = [&](std::size_t v) {
      return MeasurePlane(views_[v], *ProjectEdge(views_[v], start));
    };
    return AdjustEdge(start, {measure(0), measure(2)}, kSigmaPx);
  }

  std::optional<TrackedEdge> Track(
      const EdgeEstimate& start, const ValidationOptions& options = {}) const {
    return TrackSupport(
        start,
        indices_,
        neighbors_,
        {kFirstViews, AllViews(), FewestSupports(options, views_.size())},
        kSigmaPx,
        options);
  }

  const std::vector<TestCurve> curves_ = {
      LineCurve({-1, -1, -0.5}, {1, 0.5, 1}), CircleCurve({0, 0, -1}, 0.8)};
  std::vector<PosedView> views_;
  std::vector<EdgeMap> maps_;
  std::vector<ViewIndex> indices_;
  NeighborsByView neighbors_;
};

// The offset from the truth across the tangent, on the axes of the estimate.
Vector2d ErrorOf(const EdgeEstimate& estimate, const TestCurve& curve) {
  double s = 0;
  double least = 1e9;
  for (double at = 0; at <= curve.length; at += 1e-3) {
    const double distance =
        (curve.position(at) - estimate.edge.position).norm();
    if (distance < least) {
      least = distance;
      s = at;
    }
  }
  const Vector3d offset = estimate.edge.position - curve.position(s);
  return {offset.dot(estimate.across.col(0)),
          offset.dot(estimate.across.col(1))};
}

TEST_F(TrackSupportTest, FindsExactCurvesInEveryView) {
  for (const TestCurve& curve : curves_) {
    for (double share = 0.1; share < 0.95; share += 0.1) {
      const auto tracked = Track(Start(curve, share * curve.length, 0));
      ASSERT_TRUE(tracked) << share;
      EXPECT_GE(tracked->support.size(), 14u);
      EXPECT_LT(ErrorOf(tracked->estimate, curve).norm(), 2e-4);
      EXPECT_GT(tracked->evidence,
                ValidationOptions().min_log_likelihood_ratio);
    }
  }
}

TEST_F(TrackSupportTest, AStationSupportsOnce) {
  const auto start = Start(curves_[0], 0.5 * curves_[0].length, 0);
  const auto alone = Track(start);
  ASSERT_TRUE(alone);
  for (const std::size_t v : {5, 6, 7}) indices_[v].before_at_station = {4};
  const auto tracked = Track(start);
  ASSERT_TRUE(tracked);
  EXPECT_LT(tracked->evidence, alone->evidence);
  std::vector<EdgeRef> expected = alone->support;
  std::erase_if(expected, [](const EdgeRef& ref) {
    return ref.view_idx >= 5 && ref.view_idx <= 7;
  });
  ASSERT_EQ(expected.size() + 3, alone->support.size());
  EXPECT_EQ(tracked->support, expected);
  // But the edges of those that were not queried are found.
  const auto more = FindMoreSupport(*tracked,
                                    indices_,
                                    {4, 5, 6, 7},
                                    {kFirstViews, AllViews()},
                                    kSigmaPx,
                                    {});
  EXPECT_EQ(more.size(), 3u);
}

// A view that cannot show the edge does not speak against it.
TEST_F(TrackSupportTest, AMaskedViewHasNoVote) {
  const auto start = Start(curves_[0], 0.5 * curves_[0].length, 0);
  maps_[5].edges.resize(1);
  indices_[5].grid = GridIndex(maps_[5].edges, 4);
  const auto missed = Track(start);
  maps_[5].unseen.num_columns = 100;
  maps_[5].unseen.cells.assign(100 * 100, 1);
  const auto masked = Track(start);
  ASSERT_TRUE(missed && masked);
  EXPECT_EQ(masked->support, missed->support);
  EXPECT_GT(masked->evidence, missed->evidence);
}

TEST_F(TrackSupportTest, RejectsWhatTheFirstViewsDoNotShow) {
  const EdgeEstimate start = Start(curves_[0], 1, 0);
  const auto track = [&](const std::vector<std::int32_t>& first) {
    return TrackSupport(
        start, indices_, neighbors_, {first, AllViews()}, kSigmaPx, {});
  };
  EXPECT_TRUE(track(kFirstViews));
  EXPECT_TRUE(track({15, 3, 1, 2, 0}));
  EXPECT_FALSE(track({0, 2}));
}

TEST_F(TrackSupportTest, ListsOneEdgePerViewInOrder) {
  const auto tracked = Track(Start(curves_[0], 1, 0));
  ASSERT_TRUE(tracked);
  std::set<std::int32_t> views;
  for (const EdgeRef& ref : tracked->support) views.insert(ref.view_idx);
  EXPECT_EQ(views.size(), tracked->support.size());
  EXPECT_TRUE(std::is_sorted(tracked->support.begin(), tracked->support.end()));
}

TEST_F(TrackSupportTest, RejectsAWrongDepth) {
  // A twentieth of the depth: some 15 pixels to the side of the line from a
  // view at a right angle.
  for (const double depth : {-0.3, 0.3}) {
    for (double s = 0.3; s < 2; s += 0.1) {
      EXPECT_FALSE(Track(Start(curves_[0], s, depth))) << depth << " at " << s;
    }
  }
}

TEST_F(TrackSupportTest, RejectsWhatTooFewViewsSupport) {
  const EdgeEstimate start = Start(curves_[0], 1, 0);
  for (std::size_t i = 5; i < maps_.size(); ++i) {
    indices_[i].grid = GridIndex();
  }
  // Five views are left.
  ValidationOptions options;
  options.min_num_support_views = 3;
  EXPECT_TRUE(Track(start, options));
  options.min_num_support_views = 4;
  EXPECT_FALSE(Track(start, options));
}

TEST(FewestSupports, AreNoMoreThanJustOverHalfOfTheViewsOnOneSide) {
  ValidationOptions options;
  options.min_num_support_views = 4;
  EXPECT_EQ(FewestSupports(options, 50), 6u);
  EXPECT_EQ(FewestSupports(options, 10), 6u);
  EXPECT_EQ(FewestSupports(options, 9), 5u);
  EXPECT_EQ(FewestSupports(options, 6), 4u);
  EXPECT_EQ(FewestSupports(options, 5), 3u);
  EXPECT_EQ(FewestSupports(options, 2), 3u);
}

TEST_F(TrackSupportTest, RejectsTooLittleEvidence) {
  const EdgeEstimate start = Start(curves_[0], 1, 0);
  ValidationOptions options;
  options.min_log_likelihood_ratio = Track(start)->evidence + 0.1;
  EXPECT_FALSE(Track(start, options));
  options.min_log_likelihood_ratio -= 0.2;
  EXPECT_TRUE(Track(start, options));
}

class NoisyTrackSupportTest : public TrackSupportTest {
 protected:
  NoisyTrackSupportTest() : TrackSupportTest(kSigmaPx) {}
};

TEST_F(NoisyTrackSupportTest, ErrsAsItsCovarianceSays) {
  double mean_square = 0;
  int num_tracked = 0;
  for (const TestCurve& curve : curves_) {
    for (double s = 0.05; s < curve.length - 0.05; s += 0.02) {
      const auto tracked = Track(Start(curve, s, 0.01));
      if (!tracked) continue;
      ++num_tracked;
      const Vector2d error = ErrorOf(tracked->estimate, curve);
      mean_square += error.dot(tracked->estimate.covariance.inverse() * error);
    }
  }
  const double num_starts = (curves_[0].length + curves_[1].length) / 0.02;
  EXPECT_GT(num_tracked, 0.95 * num_starts);
  // Two degrees of freedom. Of the edges around, the nearest support, which
  // makes errors smaller.
  mean_square /= num_tracked;
  EXPECT_GT(mean_square, 0.5);
  EXPECT_LT(mean_square, 2.5);
}

TEST_F(TrackSupportTest, FindsMoreInViewsThatWereNotAsked) {
  const std::vector<std::int32_t> asked = {0, 1, 2, 3, 4, 6, 8, 10, 12, 14, 15};
  const std::vector<std::int32_t> not_asked = {5, 7, 9, 11, 13};
  for (const TestCurve& curve : curves_) {
    const auto tracked = TrackSupport(Start(curve, 0.5 * curve.length, 0),
                                      indices_,
                                      neighbors_,
                                      {kFirstViews, asked},
                                      kSigmaPx,
                                      {});
    ASSERT_TRUE(tracked);
    const auto more = [&](const std::vector<std::int32_t>& views) {
      return FindMoreSupport(
          *tracked, indices_, views, {kFirstViews, asked}, kSigmaPx, {});
    };
    EXPECT_TRUE(more(asked).empty());
    EXPECT_GE(more(not_asked).size(), 4u);
    EXPECT_TRUE(more({}).empty());
  }
}

TEST_F(TrackSupportTest, ViewsThatShowTheEdgeAlikeAreStrongerEvidence) {
  const double s = 0.5 * curves_[0].length;
  const auto evidence = [&] {
    const auto tracked = Track(Start(curves_[0], s, 0));
    return tracked ? tracked->evidence : 0;
  };
  const double unknown = evidence();
  MakeSharp(maps_);
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    indices_[i].appearance = AppearanceDensity(maps_[i].edges);
  }
  const double alike = evidence();
  SwapSides(maps_[5].edges);
  const double one_unlike = evidence();
  EXPECT_GT(unknown, 0);
  EXPECT_GT(alike, one_unlike);
  EXPECT_LT(one_unlike, alike - 1);
  EXPECT_NE(alike, unknown);
}

}  // namespace
}  // namespace curvix
