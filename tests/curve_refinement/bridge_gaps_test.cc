// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/refine_curves.h"

#include <gtest/gtest.h>
#include <iterator>

#include "geometry/edge_geometry.h"
#include "model/curve_chains.h"
#include "tests/curve_refinement/drawn_curves.h"

namespace curvix {
namespace {

constexpr CurveRefinementOptions kBridgeOptions = {.max_gap_px = 15};

// In views that show `edges`.
std::vector<Curve> BridgeIn(
    const std::vector<PosedView>& views,
    const std::vector<Curve>& curves,
    const CurveRefinementOptions& options = kBridgeOptions,
    const std::vector<Edge2d>& edges = {}) {
  EdgeMap map;
  map.edges = edges;
  const std::vector<EdgeMap> maps(views.size(), map);
  return BridgeGaps(curves,
                    {views, maps, kEdgeSigmaPx, options, 1},
                    ImageSupport(views, maps, 1));
}

std::vector<Curve> Bridge(const std::vector<Curve>& curves) {
  return BridgeIn(FrontalViews(), curves);
}

// The image of the line z = 0 from -60 to 60 px.
std::vector<Edge2d> ImageOfTheLine() {
  const PosedView view = FrontalViews()[0];
  std::vector<Edge2d> edges;
  for (double x = -60; x <= 60; x += 0.5) {
    const auto projected = ProjectEdge(view, {InPlane(x, 0), {1, 0, 0}});
    edges.push_back({projected->position,
                     static_cast<float>(std::atan2(projected->tangent.y(),
                                                   projected->tangent.x())),
                     10});
  }
  return edges;
}

// A circle with gaps, every other arc run through the other way.
std::vector<Curve> BrokenCircle(double radius_px, int num_arcs, double gap_px) {
  const double step = 2 * std::numbers::pi / num_arcs;
  std::vector<Curve> arcs;
  for (int i = 0; i < num_arcs; ++i) {
    arcs.push_back(
        Arc(radius_px, step * i, step * (i + 1) - gap_px / radius_px));
    if (i % 2 == 1) arcs.back() = Reversed(arcs.back());
  }
  return arcs;
}

// The line z = 0 without its middle.
std::vector<Curve> BrokenLine(double gap_px) {
  return {Line(InPlane(-60, 0), InPlane(0, 0)),
          Line(InPlane(gap_px, 0), InPlane(60, 0))};
}

TEST(BridgeGaps, ABrokenCircleBecomesOneClosedCurveOnTheCircle) {
  constexpr double kRadiusPx = 60;
  for (const int num_arcs : {1, 4}) {
    const std::vector<Curve> whole =
        Bridge(BrokenCircle(kRadiusPx, num_arcs, 10));
    ASSERT_EQ(whole.size(), 1u);
    EXPECT_TRUE(whole[0].closed);
    for (const CurveSample& sample : whole[0].samples) {
      EXPECT_NEAR(sample.position.norm(), kRadiusPx * kPixel, 0.02 * kPixel);
      EXPECT_NEAR(sample.tangent.dot(sample.position.normalized()), 0, 0.01);
    }
    const double girth = 2 * std::numbers::pi * kRadiusPx * kPixel;
    EXPECT_NEAR(Length(whole[0]), girth, 1e-3 * girth);
  }
}

TEST(BridgeGaps, FillsALineWithoutClaimingSupport) {
  std::vector<Curve> curves = BrokenLine(10);
  curves[0].samples.back().evidence = 25;
  curves[1].samples.front().sigma = kPixel;
  const std::vector<Curve> whole = Bridge(curves);
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_FALSE(whole[0].closed);
  int num_filled = 0;
  for (std::size_t k = 0; k < whole[0].samples.size(); ++k) {
    const CurveSample& sample = whole[0].samples[k];
    EXPECT_NEAR(sample.position.z(), 0, 1e-12);
    EXPECT_NEAR(std::abs(sample.tangent.x()), 1, 1e-12);
    if (k > 0) {
      const CurveSample& last = whole[0].samples[k - 1];
      EXPECT_LT((sample.position - last.position).norm(), 2 * kPixel);
    }
    if (!sample.support.empty()) continue;
    ++num_filled;
    EXPECT_EQ(sample.evidence, 25);
    EXPECT_EQ(sample.sigma, kPixel);
  }
  EXPECT_EQ(num_filled, 6);  // every 10 / 7 px
}

TEST(BridgeGaps, GapsAreLimited) {
  EXPECT_EQ(Bridge(BrokenLine(13)).size(), 1u);
  EXPECT_EQ(Bridge(BrokenLine(16)).size(), 2u);
  CurveRefinementOptions options = kBridgeOptions;
  options.max_gap_px = 0;
  EXPECT_EQ(BridgeIn(FrontalViews(), BrokenLine(5), options).size(), 2u);
}

TEST(BridgeGaps, LongGapsAreClosedWhereTheImagesShowThem) {
  std::vector<Edge2d> edges = ImageOfTheLine();
  const auto bridged =
      BridgeIn(FrontalViews(), BrokenLine(25), kBridgeOptions, edges);
  ASSERT_EQ(bridged.size(), 1u);
  for (const CurveSample& sample : bridged[0].samples) {
    EXPECT_FALSE(sample.support.empty());
  }
  edges.erase(edges.begin() + 130, edges.begin() + 150);  // 5 to 15 px
  EXPECT_EQ(
      BridgeIn(FrontalViews(), BrokenLine(25), kBridgeOptions, edges).size(),
      2u);
}

TEST(BridgeGaps, LongGapsWithoutEdgesStayBehindEndsWithoutEdges) {
  std::vector<Curve> curves = BrokenLine(25);
  for (int k = 1; k <= 7; ++k) {
    std::prev(curves[0].samples.end(), k)->support.clear();
  }
  EXPECT_EQ(BridgeIn(FrontalViews(), curves).size(), 2u);
}

TEST(BridgeGaps, SmallRingsClose) {
  const auto whole = Bridge(BrokenCircle(14, 2, 6));
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_TRUE(whole[0].closed);
  for (const CurveSample& sample : whole[0].samples) {
    EXPECT_NEAR(sample.position.norm(), 14 * kPixel, 0.1 * kPixel);
  }
}

TEST(BridgeGaps, BentLastSamplesDoNotMatter) {
  std::vector<Curve> curves = BrokenLine(8);
  curves[0].samples.back().position += InPlane(0, 1.2);
  const auto whole = Bridge(curves);
  ASSERT_EQ(whole.size(), 1u);
  for (const CurveSample& sample : whole[0].samples) {
    EXPECT_NEAR(sample.position.z(), 0, 0.05 * kPixel);
  }
}

TEST(BridgeGaps, BentLastSamplesOfLooseEndsStay) {
  for (const double gap_px : {8.0, 30.0}) {
    std::vector<Curve> curves = BrokenLine(gap_px);
    curves[1].samples.back().position += InPlane(0, 1.2);
    const auto bridged = Bridge(curves);
    EXPECT_EQ(bridged.size(), gap_px < kBridgeOptions.max_gap_px ? 1u : 2u);
    EXPECT_EQ(bridged.back().samples.back().position,
              curves[1].samples.back().position);
  }
}

TEST(BridgeGaps, EndsThatOverlapAreCutHalfWay) {
  const auto whole = Bridge({Line(InPlane(-60, 0), InPlane(4, 0)),
                             Line(InPlane(0, 0.5), InPlane(60, 0.5))});
  ASSERT_EQ(whole.size(), 1u);
  for (std::size_t k = 1; k < whole[0].samples.size(); ++k) {
    EXPECT_GT(std::abs(whole[0].samples[k].position.x() -
                       whole[0].samples[k - 1].position.x()),
              0.1 * kPixel);
  }
  EXPECT_NEAR(Length(whole[0]), 120 * kPixel, 0.5 * kPixel);
}

TEST(BridgeGaps, NoGapIsLongerThanWhatWasFitted) {
  std::vector<Curve> curves = BrokenLine(10);
  curves[1].samples.resize(8);
  EXPECT_EQ(Bridge(curves).size(), 2u);
  curves = BrokenLine(5);
  curves[1].samples.resize(8);
  EXPECT_EQ(Bridge(curves).size(), 1u);
}

TEST(BridgeGaps, EdgesOfACornerStayApart) {
  const double angle = std::numbers::pi / 3;
  const Eigen::Vector3d way = InPlane(std::cos(angle), std::sin(angle));
  for (const double gap_px : {0.5, 2.0, 6.0}) {
    EXPECT_EQ(Bridge({Line(InPlane(-60, 0), InPlane(-gap_px, 0)),
                      Line(gap_px * way, 60 * way)})
                  .size(),
              2u)
        << gap_px;
  }
}

TEST(BridgeGaps, LinesBesideEachOtherStayApart) {
  EXPECT_EQ(Bridge({Line(InPlane(-60, 0), InPlane(0, 0)),
                    Line(InPlane(10, 3), InPlane(60, 3))})
                .size(),
            2u);
  EXPECT_EQ(Bridge({Line(InPlane(-60, 0), InPlane(0, 0)),
                    Line(InPlane(-60, 2), InPlane(0, 2))})
                .size(),
            2u);
}

TEST(BridgeGaps, TheNearestEndIsTaken) {
  std::vector<Curve> curves = BrokenLine(10);
  curves.push_back(Line(InPlane(6, 0.1), InPlane(40, 0.1)));
  const std::vector<Curve> bridged = Bridge(curves);
  ASSERT_EQ(bridged.size(), 2u);
  const auto has_end = [&](const Curve& curve, const Eigen::Vector3d& end) {
    return curve.samples.front().position == end ||
           curve.samples.back().position == end;
  };
  for (const Curve& curve : bridged) {
    EXPECT_NE(has_end(curve, InPlane(-60, 0)),
              has_end(curve, curves[1].samples.back().position));
  }
}

TEST(BridgeGaps, DoesNotDependOnTheUnit) {
  const double factor = 1000;
  const std::vector<Curve> curves = BrokenCircle(50, 3, 8);
  const std::vector<Curve> bridged =
      BridgeIn(Scaled(FrontalViews(), factor), Scaled(curves, factor));
  EXPECT_LT(LargestDistance(bridged, Scaled(Bridge(curves), factor)),
            1e-9 * factor);
}

}  // namespace
}  // namespace curvix
