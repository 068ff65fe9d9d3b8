// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/group_edges.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "curve_drawing/link_edges.h"
#include "paper/align_edges.h"
#include "tests/support/synthetic_edges.h"

namespace curvix {
namespace {

std::vector<Curve> CurvesOf(const SyntheticEdges& made, int num_threads = 2) {
  const NeighborhoodGraph graph =
      LinkEdges(made.edges, made.edge_maps, made.views, {}, num_threads);
  return GroupEdges(made.edges, graph, made.views, {}, num_threads);
}

// Five tracks with an eighth of a pixel of noise in each.
SyntheticEdges Noisy(const std::vector<TestCurve>& curves) {
  SyntheticEdgeOptions noise;
  noise.num_tracks = 5;
  noise.track_sigma = 0.0005;
  noise.lateral_sigma = 0.0008;
  noise.tangent_sigma = 0.03;
  return MakeSyntheticEdges(curves, noise);
}

double TotalLength(const std::vector<Curve>& curves) {
  double sum = 0;
  for (const Curve& curve : curves) sum += Length(curve);
  return sum;
}

// No step leads back, nor across.
void ExpectNoZigZag(const Curve& curve) {
  for (std::size_t k = 1; k < curve.samples.size(); ++k) {
    const Eigen::Vector3d step =
        curve.samples[k].position - curve.samples[k - 1].position;
    EXPECT_GT(step.normalized().dot(curve.samples[k].tangent), 0.6) << k;
  }
}

TEST(GroupEdges, DrawsALineOnce) {
  const auto curves = CurvesOf(Noisy({LineCurve({-1, 0, 0}, {1, 0.2, 0.3})}));
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_FALSE(curves[0].closed);
  EXPECT_NEAR(Length(curves[0]), 2.032, 0.02 * 2.032);
  ExpectNoZigZag(curves[0]);
}

TEST(GroupEdges, ClosesACircle) {
  for (const double radius : {0.1, 0.7}) {
    const auto curves =
        CurvesOf(Noisy({CircleCurve(Eigen::Vector3d::Zero(), radius)}));
    ASSERT_EQ(curves.size(), 1u);
    EXPECT_TRUE(curves[0].closed);
    EXPECT_NEAR(Length(curves[0]), 6.283 * radius, 0.02 * 6.283 * radius);
    ExpectNoZigZag(curves[0]);
  }
}

TEST(GroupEdges, FollowsAHelix) {
  const TestCurve helix = HelixCurve(0.8, 0.4, 1.5);
  const auto curves = CurvesOf(Noisy({helix}));
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_FALSE(curves[0].closed);
  EXPECT_NEAR(Length(curves[0]), helix.length, 0.02 * helix.length);
}

TEST(GroupEdges, EndsAtTheCornersOfACube) {
  const auto curves = CurvesOf(Noisy(CubeCurves()));
  EXPECT_EQ(curves.size(), 12u);
  for (const Curve& curve : curves) {
    EXPECT_NEAR(Length(curve), 2, 0.05);
    const Eigen::Vector3d chord =
        curve.samples.back().position - curve.samples.front().position;
    EXPECT_GT(chord.cwiseAbs().maxCoeff(), 0.99 * chord.norm());
  }
}

// Three quarters of a pixel of noise, first drawn together (Sec. 5).
TEST(GroupEdges, MakesOneCurveOfRoughTracksOnceTheyAreAligned) {
  SyntheticEdgeOptions noise;
  noise.num_tracks = 6;
  noise.track_sigma = 0.003;
  noise.lateral_sigma = 0.003;
  noise.tangent_sigma = 0.1;
  const SyntheticEdges made =
      MakeSyntheticEdges({CircleCurve(Eigen::Vector3d::Zero(), 0.7)}, noise);
  const NeighborhoodGraph graph =
      LinkEdges(made.edges, made.edge_maps, made.views, {}, 2);
  AlignmentOptions alignment;
  alignment.num_iterations = 5;
  alignment.step_size = 0.5;
  const auto curves = GroupEdges(
      AlignEdges(made.edges, graph, alignment, 2), graph, made.views, {}, 2);
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_TRUE(curves[0].closed);
  EXPECT_NEAR(Length(curves[0]), 6.283 * 0.7, 0.01 * 6.283 * 0.7);
  ExpectNoZigZag(curves[0]);
}

TEST(GroupEdges, CarriesSupportWithAtMostOneEdgePerView) {
  const std::vector<Curve> curves = CurvesOf(Noisy({CubeCurves()[0]}));
  ASSERT_FALSE(curves.empty());
  for (const Curve& curve : curves) {
    ASSERT_FALSE(curve.samples.empty());
    for (const CurveSample& sample : curve.samples) {
      EXPECT_NEAR(sample.tangent.norm(), 1, 1e-12);
      ASSERT_FALSE(sample.support.empty());
      for (std::size_t k = 1; k < sample.support.size(); ++k) {
        EXPECT_LT(sample.support[k - 1].view_idx, sample.support[k].view_idx);
      }
    }
  }
}

bool AreEqual(const std::vector<Curve>& a, const std::vector<Curve>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](auto& x, auto& y) {
        return x.closed == y.closed &&
               std::equal(x.samples.begin(),
                          x.samples.end(),
                          y.samples.begin(),
                          y.samples.end(),
                          [](auto& p, auto& q) {
                            return p.position == q.position &&
                                   p.tangent == q.tangent &&
                                   p.support == q.support;
                          });
      });
}

TEST(GroupEdges, DoesNotDependOnTheNumberOfThreads) {
  const SyntheticEdges made = Noisy(CubeCurves());
  const auto curves = CurvesOf(made, 1);
  EXPECT_TRUE(AreEqual(curves, CurvesOf(made, 2)));
  EXPECT_TRUE(AreEqual(curves, CurvesOf(made, 5)));
}

TEST(GroupEdges, FindsTheSameCurvesForReversedEdges) {
  SyntheticEdges made = Noisy(CubeCurves());
  const auto curves = CurvesOf(made);
  std::reverse(made.edges.begin(), made.edges.end());
  const auto reversed = CurvesOf(made);
  EXPECT_EQ(reversed.size(), curves.size());
  EXPECT_NEAR(
      TotalLength(reversed), TotalLength(curves), 0.01 * TotalLength(curves));
}

// Scales by a power of two, so that nothing is rounded differently.
TEST(GroupEdges, MovesAndScalesWithTheWorld) {
  SyntheticEdges made = Noisy({CircleCurve(Eigen::Vector3d::Zero(), 0.5)});
  const auto here = CurvesOf(made);
  Eigen::Matrix3d rotation;  // x -> y -> z -> x
  rotation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  const double scale = 1024;
  for (Edge3d& edge : made.edges) {
    edge.position = scale * (rotation * edge.position);
    edge.tangent = rotation * edge.tangent;
  }
  for (PosedView& view : made.views) {
    view.rotation = view.rotation * rotation.transpose();
    view.translation *= scale;
    view.center = scale * (rotation * view.center);
  }
  const auto there = CurvesOf(made);
  ASSERT_EQ(there.size(), here.size());
  EXPECT_NEAR(TotalLength(there), scale * TotalLength(here), 1e-6 * scale);
  EXPECT_EQ(there[0].closed, here[0].closed);
}

TEST(GroupEdges, StopsWhenAskedTo) {
  const SyntheticEdges made =
      Noisy({CircleCurve(Eigen::Vector3d::Zero(), 0.5)});
  const NeighborhoodGraph graph =
      LinkEdges(made.edges, made.edge_maps, made.views, {}, 2);
  for (int last = 1; last <= 4; ++last) {
    int num_asked = 0;
    const auto curves = GroupEdges(
        made.edges, graph, made.views, {}, 2, [&](int step, int num_steps) {
          EXPECT_EQ(step, ++num_asked);
          EXPECT_LT(step, num_steps);
          return step < last;
        });
    EXPECT_EQ(num_asked, last);
    EXPECT_TRUE(curves.empty());
  }
}

TEST(GroupEdges, GivesNothingForDegenerateInput) {
  const std::vector<PosedView> views = RingOfViews(3);
  EXPECT_TRUE(GroupEdges({}, {}, views, {}, 2).empty());
  const std::vector<Edge3d> one(1);
  EXPECT_TRUE(
      GroupEdges(one, NeighborhoodGraph::FromRows({{}}, 1), views, {}, 2)
          .empty());
  std::vector<Edge3d> heap(20);
  for (Edge3d& edge : heap) edge.support = {{0, 0}, {1, 0}};
  std::vector<EdgeMap> maps(3);
  for (EdgeMap& map : maps) {
    map.edges.resize(1);
    map.neighbors.resize(1);
  }
  const auto graph = LinkEdges(heap, maps, views, {}, 2);
  EXPECT_EQ(graph.NumLinks(), 190u);
  EXPECT_TRUE(GroupEdges(heap, graph, views, {}, 2).empty());
}

}  // namespace
}  // namespace curvix
