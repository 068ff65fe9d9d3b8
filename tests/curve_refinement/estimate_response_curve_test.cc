// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/response_curve.h"

#include <gtest/gtest.h>
#include <numbers>
#include <vector>

#include "tests/curve_refinement/seen_curves.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

const ResponseCurve kResponse = {{0.5, 0.3}};

// A light and a dark side, as behind an edge of the object another background
// may show in each view.
void SetSides(Random& random, Edge2d& edge) {
  constexpr double kSharpness = 0.8;
  const double half_contrast = 10 + 30 * random.Uniform();
  edge.level = Eigen::half(60 + 140 * random.Uniform());
  edge.sharpness = static_cast<float>(kSharpness);
  edge.strength = static_cast<float>(
      half_contrast / std::sqrt(std::numbers::pi / 2 / kSharpness));
  if (random.Uniform() < 0.5) edge.angle += std::numbers::pi_v<float>;
}

// Eighty lines in eight views. All edges of a line in a view have the same
// sides, and lie where `response` puts them, but for noise.
SeenCurves SeeLines(const Eigen::Vector2d& response_px, int length_px = 40) {
  Random random(3);
  SeenCurves seen;
  seen.views = EightViews();
  for (int i = 0; i < 80; ++i) {
    const double angle = std::numbers::pi * i / 80;
    const Eigen::Vector3d half =
        length_px / 2.0 * InPlane(std::cos(angle), std::sin(angle));
    seen.curves.push_back(Line(-half, half));
  }
  seen.edge_maps = SupportByEdges(seen.views, seen.curves);
  for (const Curve& line : seen.curves) {
    std::vector<Edge2d> sides(seen.views.size());
    for (Edge2d& edge : sides) SetSides(random, edge);
    for (const CurveSample& sample : line.samples) {
      for (const EdgeRef& ref : sample.support) {
        const auto v = static_cast<std::size_t>(ref.view_idx);
        Edge2d& edge =
            seen.edge_maps[v].edges[static_cast<std::size_t>(ref.edge_idx)];
        edge.level = sides[v].level;
        edge.strength = sides[v].strength;
        edge.sharpness = sides[v].sharpness;
        edge.angle += sides[v].angle;
        MoveAcross(
            0.03 * random.Normal() - ResponseShift(edge).dot(response_px),
            edge);
      }
    }
  }
  return seen;
}

Eigen::Vector2d EstimatedResponse(const SeenCurves& seen, int num_threads = 1) {
  return EstimateResponseCurve(
             seen.curves,
             {seen.views, seen.edge_maps, kEdgeSigmaPx, {}, num_threads})
      .px;
}

TEST(EstimateResponseCurve, IsFoundFromHowViewsDiffer) {
  const Eigen::Vector2d found = EstimatedResponse(SeeLines(kResponse.px));
  EXPECT_LT((found - kResponse.px).norm(), 0.1);
}

TEST(EstimateResponseCurve, OneOfItsPartsMayBeAll) {
  const Eigen::Vector2d gamma(0.6, 0), shoulder(0, 0.6);
  EXPECT_LT((EstimatedResponse(SeeLines(gamma)) - gamma).norm(), 0.1);
  EXPECT_LT((EstimatedResponse(SeeLines(shoulder)) - shoulder).norm(), 0.1);
}

TEST(EstimateResponseCurve, WithoutResponseThereIsNone) {
  EXPECT_LT(EstimatedResponse(SeeLines({0, 0})).norm(), 0.05);
}

TEST(EstimateResponseCurve, BrightnessDoesNotGrowFasterThanLight) {
  EXPECT_EQ(EstimatedResponse(SeeLines(-kResponse.px)),
            Eigen::Vector2d::Zero());
}

TEST(EstimateResponseCurve, OnePlaceInFourViewsTellsLittle) {
  SeenCurves seen = SeeLines(kResponse.px, 8);
  seen.curves.resize(1);
  for (CurveSample& sample : seen.curves[0].samples) sample.support.resize(4);
  EXPECT_LT(EstimatedResponse(seen).norm(), 0.2 * kResponse.px.norm());
}

TEST(EstimateResponseCurve, WithoutCurvesThereIsNone) {
  EXPECT_EQ(EstimatedResponse({}), Eigen::Vector2d::Zero());
}

TEST(EstimateResponseCurve, EdgesOfUnknownLevelTellNothing) {
  SeenCurves seen = SeeLines(kResponse.px);
  for (EdgeMap& map : seen.edge_maps) {
    for (Edge2d& edge : map.edges) edge.level = Eigen::half(0);
  }
  EXPECT_EQ(EstimatedResponse(seen), Eigen::Vector2d::Zero());
}

TEST(EstimateResponseCurve, DoesNotDependOnTheUnit) {
  SeenCurves seen = SeeLines(kResponse.px);
  const Eigen::Vector2d found = EstimatedResponse(seen);
  seen.curves = Scaled(std::move(seen.curves), 1000);
  seen.views = Scaled(std::move(seen.views), 1000);
  EXPECT_LT((EstimatedResponse(seen) - found).norm(), 1e-6);
}

TEST(EstimateResponseCurve, ThreadsChangeNothing) {
  const SeenCurves seen = SeeLines(kResponse.px);
  EXPECT_EQ(EstimatedResponse(seen, 1), EstimatedResponse(seen, 3));
}

}  // namespace
}  // namespace curvix
