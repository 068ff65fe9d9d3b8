// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/consolidate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Vector2d;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// The line y = 7, along which Direction() is -x.
const Line2 kLine{{0, 1}, -7};

LineEdge At(double along, double degrees, std::int32_t edge_idx) {
  LineEdge edge;
  edge.edge.position = along * kLine.Direction() - kLine.offset * kLine.normal;
  edge.edge.tangent = {std::cos(DegToRad(degrees)),
                       std::sin(DegToRad(degrees))};
  edge.edge_idx = edge_idx;
  return edge;
}

struct Cluster {
  ImageEdge edge;
  std::vector<std::int32_t> members;
};

std::vector<Cluster> Clusters(const std::vector<LineEdge>& edges,
                              const ConsolidationOptions& options = {}) {
  std::vector<Cluster> clusters;
  const VirtualEdges found = ClusterEdges(edges, kLine, options);
  for (const VirtualEdge& edge : found.edges) {
    const auto members = found.MembersOf(edge);
    clusters.push_back({edge.edge, {members.begin(), members.end()}});
  }
  return clusters;
}

double Along(const Cluster& edge) {
  return kLine.Direction().dot(edge.edge.position);
}

double AngleTo(const Cluster& edge, double degrees) {
  return RadToDeg(UndirectedDifference(
      std::atan2(edge.edge.tangent.y(), edge.edge.tangent.x()),
      DegToRad(degrees)));
}

TEST(ClusterEdges, AgreesWithAWorkedExample) {
  // 0.0 and 0.3 merge first (0.15), then 1.0 joins them (0.85 away, centre
  // 13/30), then 1.9 is 1.47 away and stays alone.
  const auto clusters = Clusters(
      {At(0.0, 90, 4), At(1.0, 90, 2), At(0.3, 90, 9), At(1.9, 90, 1)});
  ASSERT_EQ(clusters.size(), 2u);
  EXPECT_NEAR(Along(clusters[0]), 1.3 / 3, 1e-12);
  EXPECT_THAT(clusters[0].members, ElementsAre(4, 9, 2));
  EXPECT_NEAR(Along(clusters[1]), 1.9, 1e-12);
  EXPECT_THAT(clusters[1].members, ElementsAre(1));
  for (const Cluster& cluster : clusters) {
    EXPECT_NEAR(kLine.SignedDistance(cluster.edge.position), 0, 1e-12);
    EXPECT_NEAR(cluster.edge.tangent.norm(), 1, 1e-12);
  }
}

TEST(ClusterEdges, MergesTheClosestPairFirst) {
  // 0.9 and 1.5 first: their centre 1.2 is out of reach of 0. Had the first
  // two merged, 1.5 would be left alone.
  const auto clusters =
      Clusters({At(0, 90, 0), At(0.9, 90, 1), At(1.5, 90, 2)});
  ASSERT_EQ(clusters.size(), 2u);
  EXPECT_THAT(clusters[0].members, ElementsAre(0));
  EXPECT_THAT(clusters[1].members, ElementsAre(1, 2));
}

TEST(ClusterEdges, MergesTheFirstAlongTheLineOfPairsEquallyClose) {
  const auto clusters =
      Clusters({At(1.5, 90, 0), At(0.75, 90, 1), At(0, 90, 2)});
  ASSERT_EQ(clusters.size(), 2u);
  EXPECT_THAT(clusters[0].members, ElementsAre(2, 1));
  EXPECT_THAT(clusters[1].members, ElementsAre(0));
}

TEST(ClusterEdges, AveragesDirectionsOnTheCircle) {
  const auto across_zero = Clusters({At(0, 1, 0), At(0.4, 179, 1)});
  ASSERT_EQ(across_zero.size(), 1u);
  EXPECT_LT(AngleTo(across_zero[0], 0), 1e-9);

  const auto opposite = Clusters({At(0, 60, 0), At(0.4, 60 - 180, 1)});
  ASSERT_EQ(opposite.size(), 1u);
  EXPECT_LT(AngleTo(opposite[0], 60), 1e-9);
}

TEST(ClusterEdges, WeighsDirectionsByTheDistanceFromTheCentroid) {
  ConsolidationOptions options;
  options.max_cluster_distance_px = 3;
  options.angle_weight_sigma_px = 0.5;
  // Centroid 1: the two at 0.5 outweigh the one at 2.
  const auto clusters =
      Clusters({At(0.5, 80, 0), At(0.5, 80, 1), At(2, 95, 2)}, options);
  ASSERT_EQ(clusters.size(), 1u);
  const double near = 2 * std::exp(-0.5), far = std::exp(-2.0);
  const double expected = 80 + 15 * far / (near + far);
  // Doubled angles average like numbers to third order in their difference.
  EXPECT_LT(AngleTo(clusters[0], expected), 0.2);
}

TEST(ClusterEdges, KeepsApartWhatDiffersInDirection) {
  EXPECT_EQ(Clusters({At(0, 80, 0), At(0.1, 99, 1)}).size(), 1u);
  EXPECT_EQ(Clusters({At(0, 80, 0), At(0.1, 101, 1)}).size(), 2u);
}

TEST(ClusterEdges, PassesOverAPairThatDiffersInDirection) {
  // A crossing contour between two parts of one contour.
  const auto clusters =
      Clusters({At(0, 90, 0), At(0.3, 30, 1), At(0.8, 90, 2)});
  ASSERT_EQ(clusters.size(), 2u);
  EXPECT_THAT(clusters[0].members, ElementsAre(1));
  EXPECT_THAT(clusters[1].members, ElementsAre(0, 2));
}

std::vector<LineEdge> RandomEdges(int count, double length, Random& random) {
  std::vector<LineEdge> edges;
  for (std::int32_t i = 0; i < count; ++i) {
    edges.push_back(At(random.Uniform(0, length), random.Uniform(0, 180), i));
  }
  return edges;
}

TEST(ClusterEdges, DoesNotDependOnTheOrderOfTheInput) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<LineEdge> edges = RandomEdges(60, 20, random);
    for (std::int32_t i = 0; i < 30; ++i) {  // many in one place
      edges.push_back(At(i % 3, 25 * i, 60 + i));
    }
    const auto clusters = Clusters(edges);
    std::reverse(edges.begin(), edges.end());
    const auto same = Clusters(edges);
    ASSERT_EQ(same.size(), clusters.size());
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      EXPECT_EQ(same[i].members, clusters[i].members);
      EXPECT_EQ(same[i].edge.position, clusters[i].edge.position);
      EXPECT_EQ(same[i].edge.tangent, clusters[i].edge.tangent);
    }
  }
}

TEST(ClusterEdges, KeepsEveryEdgeOnceAndLeavesNothingToMerge) {
  Random random(2);
  const ConsolidationOptions options;
  for (int trial = 0; trial < 20; ++trial) {
    const auto clusters = Clusters(RandomEdges(100, 60, random), options);
    std::vector<std::int32_t> all;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      all.insert(
          all.end(), clusters[i].members.begin(), clusters[i].members.end());
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_LE(Along(clusters[j]), Along(clusters[i]));
        const double distance = Along(clusters[i]) - Along(clusters[j]);
        const Vector2d& t = clusters[j].edge.tangent;
        EXPECT_TRUE(distance > options.max_cluster_distance_px ||
                    AngleTo(clusters[i], RadToDeg(std::atan2(t.y(), t.x()))) >
                        options.max_cluster_angle_deg);
      }
    }
    std::sort(all.begin(), all.end());
    ASSERT_EQ(all.size(), 100u);
    for (std::int32_t i = 0; i < 100; ++i) {
      EXPECT_EQ(all[static_cast<std::size_t>(i)], i);
    }
  }
}

TEST(ClusterEdges, DoesNotChainAlongALongRun) {
  // Centroids, not nearest members, decide: no cluster outgrows the limit.
  std::vector<LineEdge> edges;
  for (std::int32_t i = 0; i < 200; ++i) edges.push_back(At(0.1 * i, 90, i));
  const auto clusters = Clusters(edges);
  EXPECT_GT(clusters.size(), 9u);
  for (const Cluster& cluster : clusters) {
    EXPECT_LE(cluster.members.size(), 21u);
  }
}

TEST(ClusterEdges, MakesNothingOfNothing) {
  EXPECT_THAT(Clusters({}), IsEmpty());
}

}  // namespace
}  // namespace curvix
