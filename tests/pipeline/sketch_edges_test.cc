// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/sketch_edges.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "geometry/detected_edge.h"
#include "tests/support/random.h"
#include "tests/support/synthetic_edges.h"
#include "tests/support/test_views.h"

namespace curvix {
namespace {

EdgeSketch SketchOf(const TestCurve& curve, int num_views) {
  const std::vector<PosedView> views = RingOfViews(num_views);
  return SketchViews(
      views, ExactEdgeMaps({curve}, views, 1), {}, Options(), [](int, int) {
        return true;
      });
}

// A view does not ask again for what a 3D edge shows in it, whether or not that
// view was asked about the 3D edge.
TEST(SketchViews, DoesNotGrowWithTheNumberOfViews) {
  const TestCurve circle = CircleCurve({0, 0, 0}, 0.8);
  const std::size_t of_few = SketchOf(circle, 64).edges.size();
  const std::size_t of_many = SketchOf(circle, 192).edges.size();
  EXPECT_GT(of_few, 300u);
  EXPECT_LT(static_cast<double>(of_many), 1.5 * static_cast<double>(of_few));
}

TEST(SketchViews, CountsRepeatedViews) {
  std::vector<PosedView> views = RingOfViews(16);
  views.insert(views.end(), 2, views[5]);
  const std::vector<EdgeMap> maps =
      ExactEdgeMaps({CircleCurve({0, 0, 0}, 0.8)}, views, 1);
  const auto sketch = [&](const std::vector<PosedView>& some) {
    const auto num_views = static_cast<std::ptrdiff_t>(some.size());
    return SketchViews(some,
                       {maps.begin(), maps.begin() + num_views},
                       {},
                       Options(),
                       [](int, int) { return true; });
  };
  const EdgeSketch all = sketch(views);
  EXPECT_EQ(all.counts.repeated_views, 2);
  views.resize(16);
  const EdgeSketch distinct = sketch(views);
  EXPECT_EQ(distinct.counts.repeated_views, 0);
  EXPECT_EQ(all.counts.h1_edges, distinct.counts.h1_edges);
}

// Seen in the first `num_views` of 32. Errors go on along a contour, for 16
// edges.
double EdgeSigmaOf(double noise_px, std::size_t num_views) {
  std::vector<PosedView> views = RingOfViews(32);
  views.resize(num_views);
  std::vector<EdgeMap> maps =
      ExactEdgeMaps({CircleCurve({0, 0, 0}, 0.8)}, views, 1);
  Random random(3);
  for (EdgeMap& map : maps) {
    double off_px = 0;
    for (std::size_t i = 0; i < map.edges.size(); ++i) {
      if (i % 16 == 0) off_px = noise_px * random.Normal();
      const Eigen::Vector2d t = ToImageEdge(map.edges[i]).tangent;
      map.edges[i].position += off_px * Eigen::Vector2d(-t.y(), t.x());
    }
  }
  return SketchViews(views, maps, {}, Options(), [](int, int) { return true; })
      .edge_sigma_px;
}

TEST(SketchViews, FindsOutHowFarEdgesAreOff) {
  EXPECT_EQ(EdgeSigmaOf(0, 32), Options().hypotheses.EdgeSigmaPx());
  EXPECT_NEAR(EdgeSigmaOf(0.2, 32), 0.2, 0.05);
  EXPECT_NEAR(EdgeSigmaOf(0.3, 32), 0.3, 0.06);
}

TEST(SketchViews, FindsOutHowFarEdgesAreOffInFiveViews) {
  EXPECT_EQ(EdgeSigmaOf(0, 5), Options().hypotheses.EdgeSigmaPx());
  EXPECT_NEAR(EdgeSigmaOf(0.2, 5), 0.2, 0.05);
  EXPECT_NEAR(EdgeSigmaOf(0.3, 5), 0.3, 0.1);
}

// Where curves grow, a few seeds along a contour are enough.
TEST(SketchViews, FindsSeedsAllAlongAContour) {
  const std::vector<PosedView> views = RingOfViews(32);
  std::vector<EdgeMap> maps =
      ExactEdgeMaps({CircleCurve({0, 0, 0}, 0.8)}, views, 1);
  const auto sketch = [&] {
    return SketchViews(
        views, maps, {}, Options(), [](int, int) { return true; });
  };
  const EdgeSketch all = sketch();
  for (EdgeMap& map : maps) map.spacing_px = 1;  // as if crowded
  const EdgeSketch seeds = sketch();
  EXPECT_LT(4 * seeds.counts.h1_edges, all.counts.h1_edges);
  constexpr double kPixel = 1.0 / 125;
  for (const Edge3d& edge : all.edges) {
    double nearest = 1e9;
    for (const Edge3d& seed : seeds.edges) {
      nearest = std::min(nearest, (seed.position - edge.position).norm());
    }
    EXPECT_LT(nearest, 12 * kPixel);
  }
}

}  // namespace
}  // namespace curvix
