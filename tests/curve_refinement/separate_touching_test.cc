// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/refine_curves.h"

#include <gtest/gtest.h>

#include "base/angles.h"
#include "model/curve_chains.h"
#include "tests/curve_refinement/touching_curves.h"

namespace curvix {
namespace {

// What two touching curves look like in three views.
struct TouchingScene {
  std::vector<PosedView> views = {LookAt({0, -8, 0}, {0, 0, 0}),
                                  LookAt({3, -7, 2}, {0, 0, 0}),
                                  LookAt({-3, -7, 3}, {0, 0, 0})};
  std::vector<Curve> truth = {ArcUpwards(), ArcBackwards()};
  std::vector<EdgeMap> edge_maps = SupportByEdges(views, truth);

  std::vector<Curve> Separate(const std::vector<Curve>& curves) const {
    return SeparateTouching(curves,
                            {views, edge_maps, kEdgeSigmaPx, {}, 1},
                            ImageSupport(views, edge_maps, 1));
  }
};

Curve Joined(Curve curve, const Curve& next) {
  curve.samples.insert(
      curve.samples.end(), next.samples.begin(), next.samples.end());
  return curve;
}

bool RunsAlong(const Curve& curve, const Curve& truth) {
  for (const CurveSample& sample : curve.samples) {
    double least = HUGE_VAL;
    for (const CurveSample& true_sample : truth.samples) {
      least = std::min(least, (true_sample.position - sample.position).norm());
    }
    if (least > 0.8 * kPixel) return false;
  }
  return std::abs(Length(curve) - Length(truth)) < kPixel;
}

// One curve for each true one, all along it.
void ExpectTruth(const std::vector<Curve>& curves,
                 const std::vector<Curve>& truth) {
  ASSERT_EQ(curves.size(), truth.size());
  for (const Curve& true_curve : truth) {
    EXPECT_EQ(std::count_if(curves.begin(),
                            curves.end(),
                            [&](const Curve& curve) {
                              return RunsAlong(curve, true_curve);
                            }),
              1);
  }
}

TEST(SeparateTouching, ABrokenCurveIsCarriedOnThroughWhatItShares) {
  const TouchingScene scene;
  const auto& [up, back] = std::pair(scene.truth[0], scene.truth[1]);
  ExpectTruth(scene.Separate({up, Slice(back, 0, 70), Slice(back, 110, 181)}),
              scene.truth);
  ExpectTruth(
      scene.Separate({Reversed(Slice(up, 0, 75)), back, Slice(up, 105, 181)}),
      scene.truth);
}

TEST(SeparateTouching, CurvesThatWereExchangedAreExchangedBack) {
  const TouchingScene scene;
  const auto& [up, back] = std::pair(scene.truth[0], scene.truth[1]);
  const Curve mixed = Joined(Slice(up, 0, 90), Slice(back, 90, 181));
  for (const Curve& passing : {mixed, Reversed(mixed)}) {
    ExpectTruth(
        scene.Separate({Slice(back, 0, 70), passing, Slice(up, 110, 181)}),
        scene.truth);
  }
}

// A circle that touches the arc backwards.
TouchingScene SceneWithCircle() {
  TouchingScene scene;
  Curve circle = Arc(kTouchRadiusPx, -kPi / 2, 3 * kPi / 2);
  for (CurveSample& sample : circle.samples) {
    sample.position += InPlane(0, kTouchRadiusPx);
  }
  scene.truth[0] = circle;
  scene.edge_maps = SupportByEdges(scene.views, scene.truth);
  return scene;
}

TEST(SeparateTouching, ACircleThatRanAstrayIsClosed) {
  const TouchingScene scene = SceneWithCircle();
  const Curve& circle = scene.truth[0];
  const Curve& back = scene.truth[1];
  // From behind the touch all round to it, and on as the other curve.
  const int size = static_cast<int>(circle.samples.size());
  const Curve astray = Joined(Slice(circle, 20, size), Slice(back, 90, 181));
  const auto separate = scene.Separate({astray, Slice(back, 0, 70)});
  ExpectTruth(separate, scene.truth);
  EXPECT_TRUE(separate[0].closed || separate[1].closed);
}

TEST(SeparateTouching, ACircleStaysClosed) {
  const TouchingScene scene = SceneWithCircle();
  const Curve& back = scene.truth[1];
  const auto separate = scene.Separate(
      {Slice(back, 0, 70), scene.truth[0], Slice(back, 110, 181)});
  ExpectTruth(separate, scene.truth);
}

TEST(SeparateTouching, ADetourIsNoPassage) {
  const TouchingScene scene;
  const Curve& up = scene.truth[0];
  const Curve& back = scene.truth[1];
  Curve detour = Slice(up, 0, 85);
  const Curve loop = Arc(80, -kPi / 2, 3 * kPi / 2);
  for (CurveSample sample : loop.samples) {
    sample.position += InPlane(0, 80);
    detour.samples.push_back(sample);
  }
  detour = Joined(detour, Slice(back, 95, 181));
  EXPECT_EQ(
      scene.Separate({Slice(back, 0, 70), detour, Slice(up, 110, 181)}).size(),
      3u);
}

TEST(SeparateTouching, WhatTheImagesDoNotShowStaysOpen) {
  TouchingScene scene;
  const auto& [up, back] = std::pair(scene.truth[0], scene.truth[1]);
  for (EdgeMap& map : scene.edge_maps) map.edges.clear();
  const std::vector<Curve> curves = {
      up, Slice(back, 0, 70), Slice(back, 110, 181)};
  EXPECT_EQ(scene.Separate(curves).size(), 3u);
}

TEST(SeparateTouching, EndsWithoutAPassingCurveAreLeftAlone) {
  const TouchingScene scene;
  const Curve& back = scene.truth[1];
  EXPECT_EQ(scene.Separate({Slice(back, 0, 70), Slice(back, 110, 181)}).size(),
            2u);
}

}  // namespace
}  // namespace curvix
