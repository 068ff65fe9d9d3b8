// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/image_support.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/angles.h"
#include "geometry/detected_edge.h"
#include "geometry/nearest_edge.h"
#include "tests/curve_refinement/drawn_curves.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Vector2d;

std::vector<Edge2d> RandomEdges(std::size_t num, Random& random) {
  std::vector<Edge2d> edges(num);
  for (Edge2d& edge : edges) {
    edge.position = {random.Uniform(0, 100), random.Uniform(0, 100)};
    edge.angle = static_cast<float>(random.Uniform(-kPi, kPi));
  }
  return edges;
}

// Of all edges of the square of half-width `reach_px`, one by one.
std::vector<double> DistancesBeside(const std::vector<Edge2d>& edges,
                                    const ImageEdge& projected,
                                    double max_distance_px,
                                    double reach_px) {
  std::vector<double> distances;
  for (const Edge2d& edge : edges) {
    Vector2d tangent = ToImageEdge(edge).tangent;
    const double cosine = tangent.dot(projected.tangent);
    if (std::abs(cosine) < Gate().min_cosine) continue;
    if (cosine < 0) tangent = -tangent;
    const Vector2d offset = edge.position - projected.position;
    const double across = offset.dot(Vector2d(-tangent.y(), tangent.x()));
    if (offset.cwiseAbs().maxCoeff() < reach_px &&
        std::abs(across) < max_distance_px &&
        std::abs(offset.dot(tangent)) < Gate().tangential_px) {
      distances.push_back(across);
    }
  }
  std::ranges::sort(distances);
  return distances;
}

// Whether each of `some` is one of `all`, ascending, but for rounding.
bool AreAmong(const std::vector<double>& all, const std::vector<double>& some) {
  return some.size() <= all.size() &&
         std::ranges::all_of(some, [&](double distance) {
           return std::abs(NearestResidual(all, distance)) < 1e-4;
         });
}

TEST(ImageSupport, FindsTheEdgesBesideAPlaceInAnyDirection) {
  Random random(1);
  std::vector<EdgeMap> edge_maps(1);
  edge_maps[0].edges = RandomEdges(20000, random);
  const std::vector<PosedView> views = FrontalViews();
  const ImageSupport images(views, edge_maps, 1);
  std::size_t num_found = 0;
  for (int i = 0; i < 36; ++i) {
    const double angle = 2 * kPi * i / 36;
    const ImageEdge projected = {
        {random.Uniform(20, 80), random.Uniform(20, 80)},
        {std::cos(angle), std::sin(angle)}};
    for (const double max_distance_px : {1.0, 8.0, 36.0}) {
      const std::vector<double> found =
          images.Beside(0, projected, max_distance_px);
      EXPECT_TRUE(std::ranges::is_sorted(found));
      // Those that are just outside the square may be found or not.
      const auto beside = [&](double reach_px) {
        return DistancesBeside(
            edge_maps[0].edges, projected, max_distance_px, reach_px);
      };
      EXPECT_TRUE(AreAmong(found, beside(max_distance_px))) << i;
      EXPECT_TRUE(AreAmong(beside(max_distance_px + 1), found)) << i;
      num_found += found.size();
    }
  }
  EXPECT_GT(num_found, 1000u);
}

TEST(NearestResidual, GoesToTheNearestOnEitherSide) {
  const std::vector<double> edges_px = {-3, 1, 2};
  EXPECT_EQ(NearestResidual(edges_px, -5), 2);
  EXPECT_EQ(NearestResidual(edges_px, -3), 0);
  EXPECT_EQ(NearestResidual(edges_px, -1.5), -1.5);
  EXPECT_EQ(NearestResidual(edges_px, 0), 1);
  EXPECT_EQ(NearestResidual(edges_px, 5), -3);
  EXPECT_EQ(std::abs(NearestResidual(edges_px, -1)), 2);
  EXPECT_EQ(NearestResidual({}, 0), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace curvix
