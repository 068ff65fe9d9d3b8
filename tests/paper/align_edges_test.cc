// SPDX-License-Identifier: BSD-3-Clause
#include "paper/align_edges.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "curve_drawing/link_edges.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

AlignmentOptions Steps(int num_iterations, double step_size) {
  AlignmentOptions options;
  options.num_iterations = num_iterations;
  options.step_size = step_size;
  return options;
}

NeighborhoodGraph LinksOf(const SyntheticEdges& made) {
  return LinkEdges(made.edges, made.edge_maps, made.views, {}, 2);
}

NeighborhoodGraph Pair() {
  return NeighborhoodGraph::FromRows({{{1, 1, 0}}, {}}, 1);
}

TEST(PullOn, LeadsAcrossTheLineOfTheNeighborAndNotAlongIt) {
  const std::vector<SpaceEdge> points = {
      {{0, 0, 0}, Eigen::Vector3d::UnitX()},
      {{5, 1, 2}, -Eigen::Vector3d::UnitX()}};
  for (const bool use_mean_direction : {true, false}) {
    const Pull pull =
        PullOn(0, Pair().Neighbors(0), points, {1, use_mean_direction});
    EXPECT_LT((pull.force - Eigen::Vector3d(0, 1, 2)).norm(), 1e-12);
    EXPECT_LT(pull.torque.norm(), 1e-12);
  }
}

TEST(PullOn, TurnsTowardsTheNearerSenseOfTheNeighbor) {
  const Eigen::Vector3d turned(std::cos(0.3), std::sin(0.3), 0);
  for (const double sign : {1.0, -1.0}) {
    const std::vector<SpaceEdge> points = {
        {{0, 0, 0}, Eigen::Vector3d::UnitX()}, {{1, 0, 0}, sign * turned}};
    const Pull pull = PullOn(0, Pair().Neighbors(0), points, {1, true});
    EXPECT_LT((pull.torque - Eigen::Vector3d(0, std::sin(0.3), 0)).norm(),
              1e-12);
  }
}

TEST(PullOn, FallsWithDistanceAndGrowsWithTheWeightOfTheLink) {
  // Neighbours above, near, and below, far.
  const std::vector<SpaceEdge> points = {
      {{0, 0, 0}, Eigen::Vector3d::UnitX()},
      {{0, 1, 0}, Eigen::Vector3d::UnitX()},
      {{4, -1, 0}, Eigen::Vector3d::UnitX()}};
  const auto equal =
      NeighborhoodGraph::FromRows({{{1, 1, 0}, {2, 1, 0}}, {}, {}}, 1);
  EXPECT_GT(PullOn(0, equal.Neighbors(0), points, {1, true}).force.y(), 0.1);
  const auto heavy =
      NeighborhoodGraph::FromRows({{{1, 1, 0}, {2, 5, 4}}, {}, {}}, 1);
  EXPECT_LT(PullOn(0, heavy.Neighbors(0), points, {1, true}).force.y(), -0.1);
}

TEST(PullOn, IsFiniteForCoincidentEdgesAndZeroForLonelyOnes) {
  const std::vector<SpaceEdge> points(2);
  const Pull pull = PullOn(0, Pair().Neighbors(0), points, {1, true});
  EXPECT_EQ(pull.force, Eigen::Vector3d::Zero());
  EXPECT_EQ(pull.torque, Eigen::Vector3d::Zero());
  EXPECT_EQ(PullOn(0, {}, points, {1, true}).force, Eigen::Vector3d::Zero());
}

TEST(PullOn, VanishesBetweenAnyTwoTangentsOfACircle) {
  std::vector<SpaceEdge> points;
  for (const double a : {0.2, 0.9}) {
    points.push_back({{3 * std::cos(a), 3 * std::sin(a), 0},
                      {-std::sin(a), std::cos(a), 0}});
  }
  const auto with = [&](bool use_mean_direction) {
    return PullOn(0, Pair().Neighbors(0), points, {1, use_mean_direction});
  };
  EXPECT_LT(with(true).force.norm(), 1e-12);
  // The paper's pull: outwards by R (1 - cos(0.7)).
  EXPECT_NEAR(with(false).force.norm(), 3 * (1 - std::cos(0.7)), 1e-12);
}

TEST(AlignEdges, CollapsesParallelTracksOntoOneLine) {
  SyntheticEdgeOptions noise;
  noise.num_tracks = 5;
  noise.track_sigma = 0.004;
  const Eigen::Vector3d direction = Eigen::Vector3d(2, 0.4, 0.6).normalized();
  const SyntheticEdges made =
      MakeSyntheticEdges({LineCurve(-0.5 * direction, 0.5 * direction)}, noise);
  const auto aligned =
      AlignEdges(made.edges, LinksOf(made), Steps(1000, 0.1), 2);
  // The spread across the line, about the mean offset of all edges.
  const auto spread = [&](const std::vector<Edge3d>& edges) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Edge3d& edge : edges) mean += edge.position.cross(direction);
    mean /= static_cast<double>(edges.size());
    double sum = 0;
    for (const Edge3d& edge : edges) {
      sum += (edge.position.cross(direction) - mean).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(edges.size()));
  };
  EXPECT_GT(spread(made.edges), 0.003);
  EXPECT_LT(spread(aligned), 0.1 * spread(made.edges));
}

TEST(AlignEdges, KeepsTheRadiusOfACircleUnlessAskedToFollowThePaper) {
  SyntheticEdgeOptions noise;
  noise.num_tracks = 3;
  const double radius = 0.2;
  const SyntheticEdges made =
      MakeSyntheticEdges({CircleCurve(Eigen::Vector3d::Zero(), radius)}, noise);
  AlignmentOptions options = Steps(1000, 0.01);
  const auto mean_radius = [&] {
    const auto aligned = AlignEdges(made.edges, LinksOf(made), options, 2);
    double sum = 0;
    for (const Edge3d& edge : aligned) sum += edge.position.norm();
    return sum / static_cast<double>(aligned.size());
  };
  EXPECT_NEAR(mean_radius(), radius, 1e-4 * radius);
  options.use_mean_direction = false;
  EXPECT_GT(mean_radius(), radius * (1 + 1e-4));
}

TEST(AlignEdges, DoesNotMergeParallelLinesThatShareNoEdges) {
  SyntheticEdgeOptions noise;
  noise.num_tracks = 3;
  noise.lateral_sigma = 0.001;
  const double apart = 0.004;  // half a pixel
  const SyntheticEdges made =
      MakeSyntheticEdges({LineCurve({-0.5, 0, 0}, {0.5, 0, 0}),
                          LineCurve({-0.5, apart, 0}, {0.5, apart, 0})},
                         noise);
  const auto aligned =
      AlignEdges(made.edges, LinksOf(made), Steps(1000, 0.01), 2);
  for (std::size_t i = 0; i < aligned.size(); ++i) {
    EXPECT_NEAR(aligned[i].position.y(), made.curve_of[i] * apart, 0.3 * apart);
  }
}

TEST(AlignEdges, LeavesEdgesThatLieOnTheirLineAlready) {
  const SyntheticEdges made =
      MakeSyntheticEdges({LineCurve({-0.5, 0, 0}, {0.5, 0.1, 0})}, {});
  const auto aligned =
      AlignEdges(made.edges, LinksOf(made), Steps(100, 0.1), 1);
  for (std::size_t i = 0; i < aligned.size(); ++i) {
    EXPECT_LT((aligned[i].position - made.edges[i].position).norm(), 1e-12);
    EXPECT_EQ(aligned[i].support, made.edges[i].support);
  }
}

SyntheticEdges NoisyHelix() {
  SyntheticEdgeOptions noise;
  noise.num_tracks = 2;
  noise.spacing = 0.02;
  noise.lateral_sigma = 0.003;
  noise.tangent_sigma = 0.05;
  return MakeSyntheticEdges({HelixCurve(0.5, 0.3, 1)}, noise);
}

TEST(AlignEdges, MovesAndScalesWithTheWorld) {
  const SyntheticEdges made = NoisyHelix();
  const NeighborhoodGraph graph = LinksOf(made);
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized())
          .toRotationMatrix();
  const Eigen::Vector3d shift(10, -20, 5);
  const double scale = 250;
  std::vector<Edge3d> moved = made.edges;
  for (Edge3d& edge : moved) {
    edge.position = scale * (rotation * edge.position) + shift;
    edge.tangent = rotation * edge.tangent;
  }
  const AlignmentOptions options = Steps(50, 0.1);
  const auto here = AlignEdges(made.edges, graph, options, 1);
  const auto there = AlignEdges(moved, graph, options, 1);
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_LT(
        (scale * (rotation * here[i].position) + shift - there[i].position)
            .norm(),
        1e-9 * scale);
    EXPECT_LT((rotation * here[i].tangent - there[i].tangent).norm(), 1e-9);
  }
}

TEST(AlignEdges, DoesNotDependOnTheNumberOfThreads) {
  const SyntheticEdges made = NoisyHelix();
  const NeighborhoodGraph graph = LinksOf(made);
  const auto one = AlignEdges(made.edges, graph, Steps(20, 0.1), 1);
  const auto four = AlignEdges(made.edges, graph, Steps(20, 0.1), 4);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].position, four[i].position);
    EXPECT_EQ(one[i].tangent, four[i].tangent);
  }
}

TEST(AlignEdges, TakesDegenerateInput) {
  EXPECT_TRUE(AlignEdges({}, {}, Steps(10, 0.1), 2).empty());
  const std::vector<Edge3d> duplicates(2);  // in the same place
  EXPECT_EQ(AlignEdges(duplicates, Pair(), Steps(10, 0.1), 2)[0].position,
            Eigen::Vector3d::Zero());
  EXPECT_THROW((void)AlignEdges(duplicates, {}, Steps(10, 0.1), 2),
               std::logic_error);
}

}  // namespace
}  // namespace curvix
