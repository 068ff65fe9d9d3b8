// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/reconstruct.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "tests/support/random.h"
#include "tests/support/test_views.h"
#include "tests/support/wire_scene.h"

namespace curvix {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double kSize = 2;  // of the cube

TEST(ReconstructCurves, FindsExactCurvesOnce) {
  const WireScene wires = MakeWireScene(CubeAndCircle(), 16);
  const auto result =
      ReconstructCurves(wires.scene, wires.edge_maps, Options());
  ASSERT_TRUE(result.ok()) << result.status().message();
  const WireAgreement agreement =
      Compare(result->curves, wires.truth, 1e-3 * kSize);
  EXPECT_EQ(result->curves.curves.size(), wires.truth.size());
  EXPECT_GT(agreement.accurate, 0.99);
  EXPECT_LT(agreement.worst_distance, kWirePx);  // ends may stand out
  EXPECT_GT(agreement.found, 0.98);
  EXPECT_NEAR(agreement.length_ratio, 1, 0.02);
  EXPECT_EQ(std::count_if(result->curves.curves.begin(),
                          result->curves.curves.end(),
                          [](const Curve& curve) { return curve.closed; }),
            1);
  EXPECT_THAT(result->report.why_empty, IsEmpty());
}

TEST(ReconstructCurves, FindsExactCurvesAsThePaperDoes) {
  const WireScene wires = MakeWireScene(CubeAndCircle(), 16);
  const auto result =
      ReconstructCurves(wires.scene, wires.edge_maps, PaperOptions());
  ASSERT_TRUE(result.ok()) << result.status().message();
  const WireAgreement agreement = Compare(result->curves, wires.truth, kWirePx);
  EXPECT_GT(agreement.accurate, 0.99);
  EXPECT_LT(agreement.worst_distance, 2 * kWirePx);
  EXPECT_GT(agreement.found, 0.9);
}

TEST(ReconstructCurves, NamesTheEdgesBehindEverySample) {
  const WireScene wires = MakeWireScene({CubeCurves()[4]}, 10);
  const auto result =
      ReconstructCurves(wires.scene, wires.edge_maps, Options());
  ASSERT_TRUE(result.ok());
  ASSERT_FALSE(result->curves.curves.empty());
  for (const Edge3d& edge : result->edges) {
    EXPECT_GE(edge.support.size(), 6u);
    std::set<std::int32_t> views;
    for (const EdgeRef& ref : edge.support) {
      views.insert(ref.view_idx);
      const auto v = static_cast<std::size_t>(ref.view_idx);
      ASSERT_LT(static_cast<std::size_t>(ref.edge_idx),
                wires.edge_maps[v].edges.size());
    }
    EXPECT_EQ(views.size(), edge.support.size());
    EXPECT_TRUE(std::is_sorted(edge.support.begin(), edge.support.end()));
    EXPECT_NEAR(edge.tangent.norm(), 1, 1e-9);
  }
}

TEST(ReconstructCurves, FourOfSixViewsAreEnough) {
  WireScene wires = MakeWireScene({CubeCurves()[4]}, 6);
  wires.edge_maps[0] = wires.edge_maps[3] = EdgeMap();
  const auto result =
      ReconstructCurves(wires.scene, wires.edge_maps, Options());
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->curves.curves.size(), 1u) << result->report.why_empty;
}

TEST(ReconstructCurves, CountsWhatEachStageDid) {
  const WireScene wires = MakeWireScene({CubeCurves()[4]}, 10);
  const auto result =
      ReconstructCurves(wires.scene, wires.edge_maps, Options());
  ASSERT_TRUE(result.ok());
  ASSERT_FALSE(result->report.stages.empty());
  for (const StageReport& stage : result->report.stages) {
    EXPECT_FALSE(stage.name.empty());
    EXPECT_FALSE(stage.counts.empty()) << stage.name;
    EXPECT_GE(stage.wall_seconds, 0);
  }
}

// All views at one place, turned about the vertical.
WireScene TurnedInPlace() {
  std::vector<PosedView> views;
  for (int i = 0; i < 6; ++i) {
    const double turn = 0.05 * i;
    views.push_back(LookAt({6, 2, 1}, {0, 6 * std::tan(turn) + 2, 1}));
  }
  WireScene wires;
  wires.truth = {LineCurve({0, 2.5, 0}, {0, 3, 2})};
  wires.edge_maps = ExactEdgeMaps(wires.truth, views, 1);
  wires.scene = ToScene(views);
  return wires;
}

// Three views from all around.
WireScene FarApart() {
  std::vector<PosedView> views;
  for (const double angle : {0.0, 2.1, 4.2}) {
    views.push_back(
        LookAt({6 * std::cos(angle), 6 * std::sin(angle), 0}, {0, 0, 0}));
  }
  WireScene wires;
  wires.truth = {LineCurve({0, 0, -1}, {0, 0, 1})};
  wires.edge_maps = ExactEdgeMaps(wires.truth, views, 1);
  wires.scene = ToScene(views);
  return wires;
}

// Edges that have nothing to do with each other, too few to agree by chance.
WireScene UnrelatedEdges() {
  WireScene wires = MakeWireScene({CubeCurves()[0]}, 10);
  Random random(7);
  for (EdgeMap& map : wires.edge_maps) {
    map.edges.resize(60);
    map.neighbors.assign(60, {});
    for (Edge2d& edge : map.edges) {
      edge.position = {random.Uniform(5, 395), random.Uniform(5, 395)};
      edge.angle = static_cast<float>(random.Uniform(-3.1, 3.1));
    }
  }
  return wires;
}

class WhyEmptyOf : public ::testing::TestWithParam<const char*> {
 protected:
  static std::string Reason(const WireScene& wires) {
    const Options options =
        std::string(GetParam()) == "paper" ? PaperOptions() : Options();
    const auto result =
        ReconstructCurves(wires.scene, wires.edge_maps, options);
    if (!result.ok()) return "failed: " + result.status().message();
    EXPECT_THAT(result->curves.curves, IsEmpty());
    return result->report.why_empty;
  }
};

TEST_P(WhyEmptyOf, ImagesWithoutEdges) {
  WireScene wires = MakeWireScene({CubeCurves()[0]}, 6);
  wires.edge_maps.assign(6, EdgeMap());
  EXPECT_THAT(Reason(wires), HasSubstr("No edges were found in the 6 images"));
}

TEST_P(WhyEmptyOf, ImagesOfNoise) {
  WireScene wires = MakeWireScene({CubeCurves()[0]}, 6);
  EdgeMap noisy;
  noisy.noise = 20;
  wires.edge_maps.assign(6, noisy);
  EXPECT_THAT(Reason(wires),
              AllOf(HasSubstr("above the noise of the 6 images"),
                    HasSubstr("--EdgeDetection.noise_factor")));
}

TEST_P(WhyEmptyOf, ACameraThatOnlyTurned) {
  EXPECT_THAT(Reason(TurnedInPlace()),
              AllOf(HasSubstr("No two views overlap"),
                    HasSubstr("Was the camera only turned?")));
}

TEST_P(WhyEmptyOf, ViewsThatAreTooFarApart) {
  EXPECT_THAT(Reason(FarApart()),
              AllOf(HasSubstr("No two views overlap"),
                    HasSubstr("rays 115 degrees apart or more"),
                    HasSubstr("places in between"),
                    Not(HasSubstr("turned"))));
}

TEST_P(WhyEmptyOf, EdgesWithoutACounterpart) {
  WireScene wires = MakeWireScene({CubeCurves()[0]}, 6);
  for (std::size_t i = 1; i < 6; ++i) wires.edge_maps[i] = EdgeMap();
  EXPECT_THAT(Reason(wires), HasSubstr("counterpart on its epipolar line"));
}

TEST_P(WhyEmptyOf, PairsThatNoOtherViewConfirms) {
  const std::string fewest = GetParam() == std::string("paper") ? "6" : "3";
  EXPECT_THAT(Reason(UnrelatedEdges()),
              AllOf(HasSubstr("edge pairs is confirmed"),
                    HasSubstr("do at least " + fewest + " views see")));
}

TEST_P(WhyEmptyOf, CurvesThatAreTooShort) {
  const WireScene wires =
      MakeWireScene({LineCurve({0, 0, 0}, {0, 0.03, 0.04})}, 10);
  EXPECT_THAT(Reason(wires), HasSubstr("no run of them is"));
}

INSTANTIATE_TEST_SUITE_P(Presets,
                         WhyEmptyOf,
                         ::testing::Values("default", "paper"),
                         [](const auto& test) { return test.param; });

TEST(ReconstructCurves, GivesADegenerateDirectionNoArbitraryDepth) {
  // A level line and cameras that move along it: any depth fits all views.
  std::vector<PosedView> views;
  for (int i = 0; i < 8; ++i) {
    views.push_back(LookAt({6, 0.6 * i, 0}, {0, 0.6 * i, 0}));
  }
  const std::vector<TestCurve> truth = {LineCurve({0, -2, 0.5}, {0, 6, 0.5})};
  const auto result = ReconstructCurves(
      ToScene(views), ExactEdgeMaps(truth, views, 1), Options());
  ASSERT_TRUE(result.ok());
  EXPECT_THAT(result->curves.curves, IsEmpty());
  EXPECT_THAT(result->report.why_empty, HasSubstr("epipolar line"));
}

TEST(ReconstructCurves, TellsProgressStageByStage) {
  const WireScene wires = MakeWireScene({CubeCurves()[4]}, 8);
  std::vector<std::string> stages;
  const auto result =
      ReconstructCurves(wires.scene,
                        wires.edge_maps,
                        Options(),
                        [&](const std::string& stage, int done, int total) {
                          EXPECT_LE(done, total);
                          if (stages.empty() || stages.back() != stage) {
                            stages.push_back(stage);
                          }
                          return true;
                        });
  ASSERT_TRUE(result.ok());
  ASSERT_EQ(stages.size(), result->report.stages.size());
  for (std::size_t i = 0; i < stages.size(); ++i) {
    EXPECT_EQ(stages[i], result->report.stages[i].name);
  }
}

TEST(ReconstructCurves, StopsWhenProgressAsksForIt) {
  const WireScene wires = MakeWireScene({CubeCurves()[4]}, 8);
  for (const Options& options : {Options(), PaperOptions()}) {
    for (const int calls_before_stop : {0, 1, 3}) {
      int calls = 0;
      const auto result = ReconstructCurves(
          wires.scene, wires.edge_maps, options, [&](auto&&...) {
            return calls++ < calls_before_stop;
          });
      ASSERT_FALSE(result.ok());
      EXPECT_EQ(result.status().code(), StatusCode::kCancelled);
      // Once refused, nothing more is asked.
      EXPECT_EQ(calls, calls_before_stop + 1);
    }
  }
}

TEST(ReconstructCurves, StopsBeforeEachStage) {
  const WireScene wires = MakeWireScene({CubeCurves()[4]}, 8);
  for (const Options& options : {Options(), PaperOptions()}) {
    const auto whole = ReconstructCurves(wires.scene, wires.edge_maps, options);
    ASSERT_TRUE(whole.ok());
    const std::vector<StageReport>& stages = whole->report.stages;
    for (std::size_t last = 0; last < stages.size(); ++last) {
      std::vector<std::string> asked;
      const auto result =
          ReconstructCurves(wires.scene,
                            wires.edge_maps,
                            options,
                            [&](const std::string& stage, int, int) {
                              if (asked.empty() || asked.back() != stage)
                                asked.push_back(stage);
                              return stage != stages[last].name;
                            });
      EXPECT_EQ(result.status().code(), StatusCode::kCancelled);
      ASSERT_EQ(asked.size(), last + 1);
      for (std::size_t i = 0; i <= last; ++i) {
        EXPECT_EQ(asked[i], stages[i].name);
      }
    }
  }
}

TEST(ReconstructCurves, StopsWhileItConnectsEdges) {
  const WireScene wires = MakeWireScene({CubeCurves()[4]}, 8);
  const auto result =
      ReconstructCurves(wires.scene,
                        wires.edge_maps,
                        PaperOptions(),
                        [](const std::string& stage, int done, int) {
                          return stage != "connect_edges" || done == 0;
                        });
  EXPECT_EQ(result.status().code(), StatusCode::kCancelled);
}

TEST(ReconstructCurves, StopsWhileItGrowsAndRefinesCurves) {
  WireScene wires = MakeWireScene({CubeCurves()[4]}, 8);
  for (EdgeMap& map : wires.edge_maps) map.spacing_px = 1;  // crowded
  for (const char* name : {"grow_curves", "refine_curves"}) {
    int num_asked = 0;
    const auto result =
        ReconstructCurves(wires.scene,
                          wires.edge_maps,
                          Options(),
                          [&](const std::string& stage, int, int) {
                            return stage != name || ++num_asked < 2;
                          });
    EXPECT_EQ(result.status().code(), StatusCode::kCancelled) << name;
    EXPECT_EQ(num_asked, 2) << name;
  }
}

TEST(ReconstructCurves, RefusesOptionsOutOfRange) {
  const WireScene wires = MakeWireScene({CubeCurves()[4]}, 4);
  Options options;
  options.hypotheses.location_tolerance_px = -1;
  const auto result = ReconstructCurves(wires.scene, wires.edge_maps, options);
  EXPECT_EQ(result.status().code(), StatusCode::kInvalidArgument);
  EXPECT_THAT(result.status().message(), HasSubstr("location_tolerance_px"));
}

}  // namespace
}  // namespace curvix
