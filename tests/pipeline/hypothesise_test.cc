// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/hypothesise.h"

#include <gtest/gtest.h>

#include "base/angles.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

const Eigen::Vector3d kFrom(-0.7, -0.4, -0.3);
const Eigen::Vector3d kTo(0.5, 0.6, 0.8);

// A line that all views see, bright on the same side.
struct LineScene {
  std::vector<PosedView> views = RingOfViews(12);
  std::vector<EdgeMap> edge_maps =
      ExactEdgeMaps({LineCurve(kFrom, kTo)}, views, 3);
};

void TurnAround(std::vector<Edge2d>& edges) {
  for (Edge2d& edge : edges) {
    edge.angle =
        static_cast<float>(WrapDirected(static_cast<double>(edge.angle) + kPi));
  }
}

double DistanceFromLine(const Eigen::Vector3d& x) {
  const Eigen::Vector3d direction = (kTo - kFrom).normalized();
  return (x - kFrom).cross(direction).norm();
}

// How many edges of the first view find the line with those of view `h2`, and
// how many find something.
struct Found {
  int right = 0;
  int any = 0;
};

Found FindWith(const LineScene& scene, std::size_t h2, Polarity polarity) {
  const auto views = HypothesisViews::Make(scene.views[0],
                                           scene.views[h2],
                                           scene.edge_maps[h2].edges,
                                           DepthRange(),
                                           polarity,
                                           Options());
  Found found;
  for (const Edge2d& edge : scene.edge_maps[0].edges) {
    const Hypotheses result = views->Hypothesise(edge);
    if (result.hypotheses.empty()) continue;
    ++found.any;
    const Eigen::Vector3d& x = result.hypotheses.front().edge.position;
    if (DistanceFromLine(x) < 1e-3) ++found.right;
  }
  return found;
}

TEST(Hypothesise, FindsALineThatIsBrightOnTheSameSide) {
  const LineScene scene;
  const int all = static_cast<int>(scene.edge_maps[0].edges.size());
  for (const std::size_t h2 : {1U, 2U, 10U, 11U}) {
    EXPECT_GT(FindWith(scene, h2, Polarity::kSame).right, 0.9 * all) << h2;
  }
}

TEST(Hypothesise, DoesNotTakeAnEdgeForOneThatIsBrightOnTheOtherSide) {
  LineScene scene;
  const int all = static_cast<int>(scene.edge_maps[0].edges.size());
  for (const std::size_t h2 : {1U, 2U, 10U, 11U}) {
    TurnAround(scene.edge_maps[h2].edges);
    EXPECT_EQ(FindWith(scene, h2, Polarity::kSame).any, 0) << h2;
    EXPECT_GT(FindWith(scene, h2, Polarity::kAny).right, 0.9 * all) << h2;
  }
}

TEST(Hypothesise, SeesNoDifferenceInPicturesOfTheOppositeBrightness) {
  LineScene scene;
  const Found before = FindWith(scene, 1, Polarity::kSame);
  TurnAround(scene.edge_maps[0].edges);
  TurnAround(scene.edge_maps[1].edges);
  EXPECT_EQ(FindWith(scene, 1, Polarity::kSame).right, before.right);
}

}  // namespace
}  // namespace curvix
