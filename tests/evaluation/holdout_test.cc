// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <set>

#include "evaluation/holdout.h"
#include "tests/support/wire_scene.h"

namespace curvix {
namespace {

using ::testing::HasSubstr;

constexpr int kEvery = 4;

WireScene Wires() { return MakeWireScene(CubeAndCircle(), 24); }

TEST(ViewsHeldOut, AreSpreadFromTheMiddleOfTheFirstOnes) {
  EXPECT_EQ(*ViewsHeldOut(24, 8), (std::vector<int>{4, 12, 20}));
  EXPECT_EQ(*ViewsHeldOut(5, 4), (std::vector<int>{2}));
  EXPECT_EQ(*ViewsHeldOut(4, 2), (std::vector<int>{1, 3}));
}

TEST(ReconstructWithHoldout, UsesNothingOfTheViewsHeldOut) {
  const WireScene wires = Wires();
  WireScene blank = Wires();
  for (std::size_t i = 2; i < blank.edge_maps.size(); i += 4) {
    blank.edge_maps[i] = EdgeMap();
  }
  const auto a =
      ReconstructWithHoldout(wires.scene, wires.edge_maps, Options(), kEvery);
  const auto b =
      ReconstructWithHoldout(blank.scene, blank.edge_maps, Options(), kEvery);
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
}

TEST(ReconstructWithHoldout, NamesSupportingViewsAsInTheScene) {
  const WireScene wires = Wires();
  const auto holdout =
      ReconstructWithHoldout(wires.scene, wires.edge_maps, Options(), kEvery);
  ASSERT_TRUE(holdout.ok());
  std::set<std::int32_t> view_idxs;
  for (const Edge3d& edge : holdout->reconstruction.edges) {
    for (const EdgeRef& ref : edge.support) view_idxs.insert(ref.view_idx);
  }
  EXPECT_EQ(view_idxs.size(), 18u);
  for (const std::int32_t view_idx : view_idxs) EXPECT_NE(view_idx % 4, 2);
}

TEST(ReconstructWithHoldout, SaysWhatItCannotHoldOut) {
  const WireScene wires = Wires();
  const auto message = [&wires](int every) {
    const auto holdout =
        ReconstructWithHoldout(wires.scene, wires.edge_maps, Options(), every);
    EXPECT_FALSE(holdout.ok());
    return holdout.status().message();
  };
  EXPECT_THAT(message(1), HasSubstr("every second view"));
  EXPECT_THAT(message(50), HasSubstr("None of 24 views is held out"));
}

}  // namespace
}  // namespace curvix
