// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/holdout.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/wire_scene.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;

constexpr HoldoutOptions kEveryFourth{4};

WireScene Wires() { return MakeWireScene(CubeAndCircle(), 24); }

TEST(EvaluateHoldout, ExactCurvesLieOnTheEdgesOfEveryViewHeldOut) {
  const WireScene wires = Wires();
  const auto holdout =
      EvaluateHoldout(wires.scene, wires.edge_maps, Options(), kEveryFourth);
  ASSERT_TRUE(holdout.ok()) << holdout.status().message();
  EXPECT_EQ(holdout->num_held_out, 6);
  EXPECT_GT(holdout->all.num_projections, 1000);
  EXPECT_GT(holdout->all.support, 0.99);
  EXPECT_LT(holdout->all.chance, 0.2);
  EXPECT_LT(holdout->all.median_distance_px, 0.02);
  EXPECT_GT(holdout->expected.num_projections, 1000);
  EXPECT_LE(holdout->expected.num_projections, holdout->all.num_projections);
  EXPECT_GT(holdout->expected.support, 0.99);
}

TEST(EvaluateHoldout, ViewsThatShowSomethingElseSupportLikeChance) {
  WireScene wires = Wires();
  for (std::size_t i = 3; i < wires.edge_maps.size(); i += 4) {
    for (Edge2d& edge : wires.edge_maps[i].edges) {
      edge.position += Eigen::Vector2d(17, 23);
    }
  }
  const auto holdout =
      EvaluateHoldout(wires.scene, wires.edge_maps, Options(), kEveryFourth);
  ASSERT_TRUE(holdout.ok()) << holdout.status().message();
  EXPECT_LT(holdout->all.support, 0.1);
}

TEST(EvaluateHoldout, UsesNothingOfTheViewsHeldOut) {
  const WireScene wires = Wires();
  WireScene blank = Wires();
  for (std::size_t i = 3; i < blank.edge_maps.size(); i += 4) {
    blank.edge_maps[i] = EdgeMap();
  }
  const auto a =
      EvaluateHoldout(wires.scene, wires.edge_maps, Options(), kEveryFourth);
  const auto b =
      EvaluateHoldout(blank.scene, blank.edge_maps, Options(), kEveryFourth);
  ASSERT_TRUE(a.ok() && b.ok());
  const std::vector<Curve>& curves = a->reconstruction.curves.curves;
  const std::vector<Curve>& others = b->reconstruction.curves.curves;
  ASSERT_FALSE(curves.empty());
  ASSERT_EQ(curves.size(), others.size());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    ASSERT_EQ(curves[i].samples.size(), others[i].samples.size());
    for (std::size_t k = 0; k < curves[i].samples.size(); ++k) {
      EXPECT_EQ(curves[i].samples[k].position, others[i].samples[k].position);
    }
  }
  EXPECT_EQ(b->all.support, 0);
}

TEST(EvaluateHoldout, NamesSupportingViewsAsInTheScene) {
  const WireScene wires = Wires();
  const auto holdout =
      EvaluateHoldout(wires.scene, wires.edge_maps, Options(), kEveryFourth);
  ASSERT_TRUE(holdout.ok());
  std::set<std::int32_t> view_idxs;
  for (const Edge3d& edge : holdout->reconstruction.edges) {
    for (const EdgeRef& ref : edge.support) view_idxs.insert(ref.view_idx);
  }
  EXPECT_EQ(view_idxs.size(), 18u);
  for (const std::int32_t view_idx : view_idxs) EXPECT_NE(view_idx % 4, 3);
}

TEST(EvaluateHoldout, SaysWhatItCannotHoldOut) {
  const WireScene wires = Wires();
  const auto message = [&wires](int every) {
    const auto holdout = EvaluateHoldout(
        wires.scene, wires.edge_maps, Options(), HoldoutOptions{every});
    EXPECT_FALSE(holdout.ok());
    return holdout.status().message();
  };
  EXPECT_THAT(message(1), HasSubstr("every second view"));
  EXPECT_THAT(message(25), HasSubstr("none of 24 views is held out"));
}

}  // namespace
}  // namespace curvix
