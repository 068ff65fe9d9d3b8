// SPDX-License-Identifier: BSD-3-Clause
// What must not change the curves.
#include <curvix/reconstruct.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <vector>

#include "tests/invariance/compare_runs.h"
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

Reconstruction RunWith(Options options, const WireScene& wires) {
  options.alignment.num_iterations =
      std::min(options.alignment.num_iterations, 50);  // for speed
  auto result = ReconstructCurves(wires.scene, wires.edge_maps, options);
  EXPECT_TRUE(result.ok()) << result.status().message();
  EXPECT_FALSE(result->curves.curves.empty());
  return *std::move(result);
}

class ReconstructionInvariance : public ::testing::TestWithParam<const char*> {
 protected:
  static Reconstruction Run(const WireScene& wires, int num_threads = 2) {
    Options options =
        std::string(GetParam()) == "paper" ? PaperOptions() : Options();
    options.runtime.num_threads = num_threads;
    return RunWith(options, wires);
  }
};

TEST_P(ReconstructionInvariance, ThreadsMakeNoDifference) {
  const WireScene wires = Wires();
  const Reconstruction expected = Run(wires, 1);
  for (const int num_threads : {2, 3, 8}) {
    SCOPED_TRACE(num_threads);
    ExpectIdentical(Run(wires, num_threads), expected);
  }
}

TEST_P(ReconstructionInvariance, TheWorldsFrameAndUnitMakeNoDifference) {
  const WireScene wires = Wires();
  const Reconstruction expected = Run(wires);
  Random random(5);
  const Eigen::Quaterniond turn(random.Rotation());
  for (const double scale : {1.0, 1000.0, 0.001}) {
    SCOPED_TRACE(scale);
    const Eigen::Vector3d move = 20 * scale * random.UnitVector();
    const OtherWorld world{turn, move, scale};
    WireScene moved = wires;
    moved.scene = world.Moved(wires.scene);
    ExpectSameSet(world.Back(Run(moved).curves), expected.curves, 1e-9);
  }
}

TEST_P(ReconstructionInvariance, TheOrderOfViewsMakesNoDifference) {
  const WireScene wires = Wires();
  const Reconstruction expected = Run(wires);
  WireScene reversed = wires;
  std::reverse(reversed.scene.views.begin(), reversed.scene.views.end());
  std::reverse(reversed.edge_maps.begin(), reversed.edge_maps.end());
  ExpectSameSet(Run(reversed).curves, expected.curves, 1e-9);
}

TEST(RepeatedViews, MakeNoDifference) {
  const WireScene wires = Wires();
  WireScene video = wires;
  for (int times = 0; times < 3; ++times) {
    for (std::size_t i = 0; i < 5; ++i) {
      video.scene.views.push_back(wires.scene.views[i]);
      video.edge_maps.push_back(wires.edge_maps[i]);
    }
  }
  for (const bool grows : {false, true}) {
    SCOPED_TRACE(grows ? "grown" : "linked");
    WireScene single = wires;
    for (std::vector<EdgeMap>* maps : {&video.edge_maps, &single.edge_maps}) {
      for (EdgeMap& map : *maps) map.spacing_px = grows ? 1 : 0.5;
    }
    const Reconstruction expected = RunWith({}, single);
    ExpectSameSet(RunWith({}, video).curves, expected.curves, 1e-9);
    Options all_views;
    all_views.validation.min_view_angle_deg = 0;
    const Reconstruction counted = RunWith(all_views, video);
    EXPECT_GT(counted.edges.front().support.size(),
              expected.edges.front().support.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Presets,
                         ReconstructionInvariance,
                         ::testing::Values("default", "paper"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace curvix
