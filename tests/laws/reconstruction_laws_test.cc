// SPDX-License-Identifier: BSD-3-Clause
// What must not change the curves.
#include <curvix/reconstruct.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/random.h"
#include "tests/support/wire_scene.h"

namespace curvix {
namespace {

// Small, but with all that a scene has: crossings, corners, a closed curve,
// noise. Without noise many distances are equal, and rounding breaks the ties.
WireScene Wires() {
  const std::vector<TestCurve> cube = CubeCurves();
  WireScene wires = MakeWireScene(
      {cube[0], cube[4], cube[8], CircleCurve({0.1, 0, 0.05}, 0.6)}, 12);
  Random random(3);
  for (EdgeMap& map : wires.edge_maps) {
    for (Edge2d& edge : map.edges) {
      edge.position.x() += 0.05 * random.Normal();
      edge.position.y() += 0.05 * random.Normal();
    }
  }
  return wires;
}

class Laws : public ::testing::TestWithParam<const char*> {
 protected:
  static Reconstruction Run(const WireScene& wires, int num_threads = 2) {
    Options options =
        std::string(GetParam()) == "paper" ? PaperOptions() : Options();
    options.alignment.num_iterations =
        std::min(options.alignment.num_iterations, 50);  // for speed
    options.runtime.num_threads = num_threads;
    auto result = ReconstructCurves(wires.scene, wires.edge_maps, options);
    EXPECT_TRUE(result.ok()) << result.status().message();
    EXPECT_FALSE(result->curves.curves.empty());
    return *std::move(result);
  }
};

void ExpectIdentical(const Reconstruction& a, const Reconstruction& b) {
  ASSERT_EQ(a.edges.size(), b.edges.size());
  for (std::size_t i = 0; i < a.edges.size(); ++i) {
    ASSERT_EQ(a.edges[i].position, b.edges[i].position);
    ASSERT_EQ(a.edges[i].tangent, b.edges[i].tangent);
    ASSERT_EQ(a.edges[i].support, b.edges[i].support);
    ASSERT_EQ(a.edges[i].sigma, b.edges[i].sigma);
    ASSERT_EQ(a.edges[i].evidence, b.edges[i].evidence);
  }
  ASSERT_EQ(a.curves.curves.size(), b.curves.curves.size());
  for (std::size_t c = 0; c < a.curves.curves.size(); ++c) {
    const Curve& one = a.curves.curves[c];
    const Curve& other = b.curves.curves[c];
    ASSERT_EQ(one.closed, other.closed);
    ASSERT_EQ(one.samples.size(), other.samples.size());
    for (std::size_t i = 0; i < one.samples.size(); ++i) {
      ASSERT_EQ(one.samples[i].position, other.samples[i].position);
      ASSERT_EQ(one.samples[i].tangent, other.samples[i].tangent);
      ASSERT_EQ(one.samples[i].sigma, other.samples[i].sigma);
      ASSERT_EQ(one.samples[i].support, other.samples[i].support);
    }
  }
}

// The largest distance from a sample of `a` to the nearest sample of `b`.
double Deviation(const CurveSet& a, const CurveSet& b) {
  double worst = 0;
  for (const Curve& curve : a.curves) {
    for (const CurveSample& sample : curve.samples) {
      double least = std::numeric_limits<double>::infinity();
      for (const Curve& other : b.curves) {
        for (const CurveSample& candidate : other.samples) {
          least =
              std::min(least, (candidate.position - sample.position).norm());
        }
      }
      worst = std::max(worst, least);
    }
  }
  return worst;
}

void ExpectSameSet(const CurveSet& a, const CurveSet& b, double tolerance) {
  EXPECT_EQ(a.curves.size(), b.curves.size());
  EXPECT_LT(Deviation(a, b), tolerance);
  EXPECT_LT(Deviation(b, a), tolerance);
}

TEST_P(Laws, ThreadsMakeNoDifference) {
  const WireScene wires = Wires();
  const Reconstruction expected = Run(wires, 1);
  for (const int num_threads : {2, 3, 8}) {
    SCOPED_TRACE(num_threads);
    ExpectIdentical(Run(wires, num_threads), expected);
  }
}

// The scene in a world that is turned, moved and `scale` times as large.
WireScene InAnotherWorld(WireScene wires,
                         const Eigen::Quaterniond& turn,
                         const Eigen::Vector3d& move,
                         double scale) {
  for (View& view : wires.scene.views) {
    Rigid3& pose = view.cam_from_world;
    pose.rotation = (pose.rotation * turn.conjugate()).normalized();
    pose.translation = scale * pose.translation - pose.rotation * move;
  }
  return wires;
}

TEST_P(Laws, TheWorldsFrameAndUnitMakeNoDifference) {
  const WireScene wires = Wires();
  const Reconstruction expected = Run(wires);
  Random random(5);
  const Eigen::Quaterniond turn(random.Rotation());
  for (const double scale : {1.0, 1000.0, 0.001}) {
    SCOPED_TRACE(scale);
    const Eigen::Vector3d move = 20 * scale * random.UnitVector();
    CurveSet back = Run(InAnotherWorld(wires, turn, move, scale)).curves;
    for (Curve& curve : back.curves) {
      for (CurveSample& sample : curve.samples) {
        sample.position = turn.conjugate() * (sample.position - move) / scale;
      }
    }
    ExpectSameSet(back, expected.curves, 1e-9);
  }
}

TEST_P(Laws, TheOrderOfViewsMakesNoDifference) {
  const WireScene wires = Wires();
  const Reconstruction expected = Run(wires);
  WireScene reversed = wires;
  std::reverse(reversed.scene.views.begin(), reversed.scene.views.end());
  std::reverse(reversed.edge_maps.begin(), reversed.edge_maps.end());
  ExpectSameSet(Run(reversed).curves, expected.curves, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Presets,
                         Laws,
                         ::testing::Values("default", "paper"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace curvix
