// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/grow_curves.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "geometry/detected_edge.h"
#include "geometry/pixel_size.h"
#include "tests/support/random.h"
#include "tests/support/synthetic_edges.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSigmaPx = 0.15;
constexpr double kPixel = 1.0 / 125;
constexpr int kNumViews = 16;

// Curves as 16 views see them.
class Seen {
 public:
  explicit Seen(std::vector<TestCurve> curves,
                double noise_px = 0,
                std::vector<PosedView> views = RingOfViews(kNumViews))
      : curves_(std::move(curves)),
        views_(std::move(views)),
        maps_(ExactEdgeMaps(curves_, views_, 1)) {
    Random random(2);
    for (EdgeMap& map : maps_) {
      for (Edge2d& edge : map.edges) {
        const Vector2d t = ToImageEdge(edge).tangent;
        edge.position += noise_px * random.Normal() * Vector2d(-t.y(), t.x());
      }
    }
    for (int i = 0; i < kNumViews; ++i) {
      neighbors_.push_back(
          {{(i + kNumViews - 1) % kNumViews, 0.7}, {(i + 1) % kNumViews, 0.7}});
    }
  }

  std::vector<EdgeMap>& maps() { return maps_; }
  DistinctViews& distinct() { return distinct_; }

  // A seed on the curve, `off_px` beside it, supported by these views.
  Edge3d Seed(std::size_t curve_idx,
              double share,
              double evidence = 30,
              double off_px = 0,
              int num_supports = 6) const {
    const TestCurve& curve = curves_[curve_idx];
    const double s = share * curve.length;
    Edge3d seed;
    seed.position = curve.position(s);
    seed.tangent = curve.tangent(s);
    seed.evidence = evidence;
    for (std::int32_t v = 0; v < num_supports; ++v) {
      seed.support.push_back({v, Nearest(v, seed.position)});
    }
    seed.position += off_px * kPixel * seed.tangent.unitOrthogonal();
    return seed;
  }

  std::vector<Curve> Grow(const std::vector<Edge3d>& seeds,
                          const CurveGrowthOptions& options = {},
                          int num_threads = 1,
                          const ValidationOptions& validation = {}) const {
    std::vector<ViewIndex> indices;
    for (std::size_t i = 0; i < views_.size(); ++i) {
      indices.push_back({&views_[i],
                         &maps_[i],
                         GridIndex(maps_[i].edges, 4),
                         EdgeDensity(maps_[i], 800, 800),
                         AppearanceDensity(maps_[i].edges),
                         {},
                         distinct_.are_repeated[i],
                         distinct_.before_at_station[i]});
    }
    return GrowCurves(
        seeds,
        {views_, maps_, indices, neighbors_, kSigmaPx, options, validation},
        num_threads);
  }

  // The length of a step at the sample, which is a pixel in an image.
  double StepPx(const CurveSample& sample) const {
    return PixelSizeAlong(
               {sample.position, sample.tangent}, sample.support, views_) /
           kPixel;
  }

  double DistancePx(const Vector3d& x) const {
    double least = 1e9;
    for (const TestCurve& curve : curves_) {
      for (double s = 0; s <= curve.length; s += kPixel / 4) {
        least = std::min(least, (curve.position(s) - x).norm());
      }
    }
    return least / kPixel;
  }

 private:
  std::int32_t Nearest(std::int32_t view_idx, const Vector3d& x) const {
    const auto v = static_cast<std::size_t>(view_idx);
    const Vector2d pixel = views_[v].Pixel(views_[v].InCamera(x));
    const std::vector<Edge2d>& edges = maps_[v].edges;
    const auto nearest = std::min_element(
        edges.begin(), edges.end(), [&](const Edge2d& a, const Edge2d& b) {
          return (a.position - pixel).norm() < (b.position - pixel).norm();
        });
    return static_cast<std::int32_t>(nearest - edges.begin());
  }

  std::vector<TestCurve> curves_;
  std::vector<PosedView> views_;
  std::vector<EdgeMap> maps_;
  DistinctViews distinct_ = AllDistinct(Overlaps(kNumViews));
  NeighborsByView neighbors_;
};

const TestCurve kLine = LineCurve({-1, -1, -0.5}, {1, 0.5, 1});
const TestCurve kCircle = CircleCurve({0, 0, -1}, 0.8);

TEST(GrowCurves, OneSeedGivesAWholeLine) {
  const Seen seen({kLine});
  const std::vector<Curve> curves = seen.Grow({seen.Seed(0, 0.3)});
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_FALSE(curves[0].closed);
  EXPECT_NEAR(Length(curves[0]), kLine.length, 4 * kPixel);
  const std::size_t size = curves[0].samples.size();
  for (std::size_t k = 0; k < size; ++k) {
    const CurveSample& sample = curves[0].samples[k];
    const bool is_end = k < 2 || k + 2 >= size;
    EXPECT_LT(seen.DistancePx(sample.position),
              is_end ? 1.2 * seen.StepPx(sample) : 0.3)
        << k;
    // The seed itself has six.
    EXPECT_GE(sample.support.size(), is_end ? 3u : 6u) << k;
    EXPECT_GT(sample.sigma, 0);
  }
}

TEST(GrowCurves, StepsFollowTheDepth) {
  // A rail beside a walk, 4 to 20 units ahead.
  std::vector<PosedView> walk;
  for (int i = 0; i < kNumViews; ++i) {
    walk.push_back(
        LookAt({0.8 * std::sin(1.3 * i), 0.12 * i - 6, 1.2}, {0, 10, 0.3}));
  }
  const Seen seen({LineCurve({-1, -2, 0}, {-1, 14, 0})}, 0, walk);
  std::vector<double> num_samples;
  for (const double share : {0.05, 0.5, 0.95}) {
    const std::vector<Curve> curves = seen.Grow({seen.Seed(0, share)});
    ASSERT_EQ(curves.size(), 1u) << share;
    EXPECT_GT(Length(curves[0]), 15) << share;
    num_samples.push_back(static_cast<double>(curves[0].samples.size()));
  }
  EXPECT_LT(std::ranges::max(num_samples), 1.1 * std::ranges::min(num_samples));
}

TEST(GrowCurves, OneSeedGivesAWholeCircleOnce) {
  const Seen seen({kCircle});
  const std::vector<Curve> curves =
      seen.Grow({seen.Seed(0, 0.3), seen.Seed(0, 0.8), seen.Seed(0, 0.5)});
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_TRUE(curves[0].closed);
  EXPECT_NEAR(Length(curves[0]), kCircle.length, 4 * kPixel);
  for (const CurveSample& sample : curves[0].samples) {
    EXPECT_LT(seen.DistancePx(sample.position), 0.3);
  }
}

TEST(GrowCurves, RepeatedViewsAreNotQueried) {
  constexpr std::int32_t kNumQueried = 9;
  Seen seen({kLine});
  std::vector<bool>& are_repeated = seen.distinct().are_repeated;
  std::fill(are_repeated.begin() + kNumQueried, are_repeated.end(), true);
  const std::vector<Curve> curves = seen.Grow({seen.Seed(0, 0.3)});
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_NEAR(Length(curves[0]), kLine.length, 4 * kPixel);
  for (const CurveSample& sample : curves[0].samples) {
    for (const EdgeRef& ref : sample.support) {
      EXPECT_LT(ref.view_idx, kNumQueried);
    }
  }
}

// All see all of the line, so each but the first of a station could only
// confirm what this shows.
TEST(GrowCurves, OneViewOfAStationIsQueried) {
  constexpr int kNumStations = 2;
  Seen seen({kLine});
  for (int v = kNumStations; v < kNumViews; ++v) {
    seen.distinct().before_at_station[static_cast<std::size_t>(v)] = {
        v % kNumStations};
  }
  EXPECT_TRUE(seen.Grow({seen.Seed(0, 0.3)}).empty());
}

TEST(GrowCurves, TangentsLeadAlongTheCurve) {
  const Seen seen({kLine, kCircle});
  const std::vector<Curve> curves =
      seen.Grow({seen.Seed(0, 0.4), seen.Seed(1, 0.1)});
  ASSERT_EQ(curves.size(), 2u);
  for (const Curve& curve : curves) {
    ASSERT_GE(curve.samples.size(), 2u);
    for (std::size_t k = 1; k < curve.samples.size(); ++k) {
      const Vector3d step =
          curve.samples[k].position - curve.samples[k - 1].position;
      EXPECT_GT(step.normalized().dot(curve.samples[k].tangent), 0.95);
    }
  }
}

TEST(GrowCurves, ComesBackFromAWrongStart) {
  const Seen seen({kLine}, 0.1);
  const std::vector<Curve> curves = seen.Grow({seen.Seed(0, 0.5, 30, 0.8)});
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_NEAR(Length(curves[0]), kLine.length, 6 * kPixel);
  for (const CurveSample& end :
       {curves[0].samples.front(), curves[0].samples.back()}) {
    EXPECT_LT(seen.DistancePx(end.position), 1.2 * seen.StepPx(end));
  }
}

TEST(GrowCurves, ParallelLinesStayTwo) {
  const Vector3d offset(0, 0, 4 * kPixel);
  const Vector3d from(-1, 0, 0);
  const Vector3d to(1, 0, 0);
  const Seen seen({LineCurve(from, to), LineCurve(from + offset, to + offset)},
                  0.05);
  const std::vector<Curve> curves =
      seen.Grow({seen.Seed(0, 0.5), seen.Seed(1, 0.4), seen.Seed(0, 0.9)});
  ASSERT_EQ(curves.size(), 2u);
  for (const Curve& curve : curves) {
    EXPECT_NEAR(Length(curve), 2, 6 * kPixel);
    const double height = curve.samples[0].position.z();
    for (const CurveSample& sample : curve.samples) {
      EXPECT_NEAR(sample.position.z(), height, kPixel);
    }
  }
}

// Seeds that get in each other's way, and more than grow side by side.
void ExpectOneAfterTheOther(const Seen& seen) {
  std::vector<Edge3d> strongest;
  std::vector<Edge3d> seeds;
  for (const std::size_t curve_idx : {0u, 1u}) {
    for (int i = 0; i < 70; ++i) {
      seeds.push_back(seen.Seed(curve_idx, 0.1 + 0.01 * i, 100.0 - i));
    }
    strongest.push_back(seeds[seeds.size() - 70]);
  }
  const std::vector<Curve> expected = seen.Grow(strongest);
  ASSERT_EQ(expected.size(), 2u);
  for (const int num_threads : {1, 3}) {
    const std::vector<Curve> curves = seen.Grow(seeds, {}, num_threads);
    ASSERT_EQ(curves.size(), expected.size());
    for (std::size_t i = 0; i < curves.size(); ++i) {
      ASSERT_EQ(curves[i].samples.size(), expected[i].samples.size());
      for (std::size_t k = 0; k < curves[i].samples.size(); ++k) {
        EXPECT_EQ(curves[i].samples[k].position,
                  expected[i].samples[k].position);
        EXPECT_EQ(curves[i].samples[k].support, expected[i].samples[k].support);
      }
    }
  }
}

TEST(GrowCurves, OneAfterTheOtherWhateverTheNumberOfThreads) {
  Seen seen({kLine, kCircle}, 0.1);
  ExpectOneAfterTheOther(seen);
  MakeSharp(seen.maps());
  SwapSides(seen.maps()[10].edges);
  ExpectOneAfterTheOther(seen);
}

TEST(GrowCurves, EachEdgeSupportsOneCurve) {
  const Seen seen({LineCurve({-1, 0, 0}, {1, 0, 0}),
                   LineCurve({0, -1, 0}, {0, 1, 0}),
                   kCircle},
                  0.1);
  std::map<EdgeRef, std::set<std::size_t>> curves_of;
  const std::vector<Curve> curves =
      seen.Grow({seen.Seed(0, 0.2), seen.Seed(1, 0.2), seen.Seed(2, 0.2)});
  EXPECT_EQ(curves.size(), 3u) << "lines that cross go on";
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (const CurveSample& sample : curves[i].samples) {
      for (const EdgeRef& ref : sample.support) curves_of[ref].insert(i);
    }
  }
  for (const auto& [ref, owners] : curves_of) EXPECT_EQ(owners.size(), 1u);
}

// Takes the edges of the middle of a line out of every view.
void HideMiddle(double hidden_px, std::vector<EdgeMap>* maps) {
  for (EdgeMap& map : *maps) {
    const Vector2d middle =
        (map.edges.front().position + map.edges.back().position) / 2;
    std::erase_if(map.edges, [&](const Edge2d& edge) {
      return (edge.position - middle).norm() < hidden_px / 2;
    });
    map.neighbors.assign(map.edges.size(), {});
  }
}

TEST(GrowCurves, GoesOverShortGapsOnly) {
  // Seen from the front, so that all views show it at the same size.
  for (const double hidden_px : {4.0, 40.0}) {
    Seen seen({LineCurve({0, 0, -0.5}, {0, 0, 0.5})});
    HideMiddle(hidden_px, &seen.maps());
    const std::vector<Curve> curves = seen.Grow({seen.Seed(0, 0.2)});
    ASSERT_EQ(curves.size(), 1u);
    EXPECT_EQ(Length(curves[0]) > 0.9, hidden_px < 10) << hidden_px;
  }
}

TEST(GrowCurves, WhatIsTooShortLeavesItsEdgesToOthers) {
  const Seen seen({kLine});
  CurveGrowthOptions options;
  options.min_significance = 1e6;
  EXPECT_TRUE(seen.Grow({seen.Seed(0, 0.3)}, options).empty());
  // The strongest seed is turned away from the line and finds nothing.
  Edge3d wrong = seen.Seed(0, 0.5, 90);
  wrong.tangent = wrong.tangent.unitOrthogonal();
  const std::vector<Curve> curves = seen.Grow({wrong, seen.Seed(0, 0.3)});
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_NEAR(Length(curves[0]), kLine.length, 4 * kPixel);
}

constexpr std::int32_t kOther = 10;

// Of the only curve that grows.
std::ptrdiff_t NumSupportsOfOther(const Seen& seen,
                                  const ValidationOptions& validation = {}) {
  const std::vector<Curve> curves =
      seen.Grow({seen.Seed(0, 0.3)}, {}, 1, validation);
  EXPECT_EQ(curves.size(), 1u);
  std::ptrdiff_t num = 0;
  for (const CurveSample& sample : curves.at(0).samples) {
    num += std::ranges::count(sample.support, kOther, &EdgeRef::view_idx);
  }
  return num;
}

TEST(GrowCurves, TakesEdgesAsNearAsTheOptionsOfValidationSay) {
  Seen shifted({kLine}), turned({kLine});
  for (Edge2d& edge : shifted.maps()[kOther].edges) {
    edge.position += 0.4 * ToBrightSide(edge);
  }
  for (Edge2d& edge : turned.maps()[kOther].edges) {
    edge.angle += 0.2f;  // 11 degrees
  }
  ValidationOptions near;
  near.max_distance_px = 0.3;
  near.max_angle_deg = 5;
  for (const Seen* seen : {&shifted, &turned}) {
    EXPECT_GT(NumSupportsOfOther(*seen), 100);
    EXPECT_EQ(NumSupportsOfOther(*seen, near), 0);
  }
}

TEST(GrowCurves, EdgesThatAreBrightOnTheOtherSideDoNotSupport) {
  Seen seen({kLine});
  MakeSharp(seen.maps());
  EXPECT_GT(NumSupportsOfOther(seen), 100);
  SwapSides(seen.maps()[kOther].edges);
  EXPECT_EQ(NumSupportsOfOther(seen), 0);
}

TEST(GrowCurves, AsksForThreeViews) {
  const Seen seen({kLine});
  EXPECT_TRUE(seen.Grow({seen.Seed(0, 0.3, 30, 0, 2)}).empty());
  EXPECT_EQ(seen.Grow({seen.Seed(0, 0.3, 30, 0, 3)}).size(), 1u);
  EXPECT_TRUE(seen.Grow({}).empty());
}

}  // namespace
}  // namespace curvix
