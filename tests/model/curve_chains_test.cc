// SPDX-License-Identifier: BSD-3-Clause
#include "model/curve_chains.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/model/end_ties.h"

namespace curvix {
namespace {

// Along the x axis, a sample at each of `places`.
Curve CurveAt(const std::vector<double>& places) {
  Curve curve;
  for (const double x : places) {
    CurveSample& sample = curve.samples.emplace_back();
    sample.position = {x, 0, 0};
    sample.tangent = {places.back() > places.front() ? 1. : -1., 0, 0};
  }
  return curve;
}

std::vector<double> PlacesOf(const Curve& curve) {
  std::vector<double> places;
  for (const CurveSample& sample : curve.samples) {
    places.push_back(sample.position.x());
  }
  return places;
}

using Places = std::vector<double>;

// One sample, half-way.
std::vector<CurveSample> Middle(const CurveSample& from,
                                const CurveSample& to) {
  CurveSample middle = from;
  middle.position = (from.position + to.position) / 2;
  return {middle};
}

TEST(Reversed, TurnsTangentsWithTheOrder) {
  const Curve reversed = Reversed(CurveAt({1, 2, 4}));
  EXPECT_EQ(PlacesOf(reversed), (Places{4, 2, 1}));
  for (const CurveSample& sample : reversed.samples) {
    EXPECT_EQ(sample.tangent.x(), -1);
  }
  EXPECT_EQ(PlacesOf(Reversed(reversed)), (Places{1, 2, 4}));
}

TEST(StringTogether, LeavesCurvesWithoutTiesAsTheyAre) {
  std::vector<Curve> curves = {CurveAt({1, 2}), CurveAt({5, 7, 8})};
  curves[1].closed = true;
  const auto strung = StringTogether(curves, Tied(2, {}), Middle);
  ASSERT_EQ(strung.size(), 2u);
  EXPECT_EQ(PlacesOf(strung[0]), (Places{1, 2}));
  EXPECT_EQ(PlacesOf(strung[1]), (Places{5, 7, 8}));
  EXPECT_FALSE(strung[0].closed);
  EXPECT_TRUE(strung[1].closed);
}

TEST(StringTogether, PutsOneCurveAfterTheOtherAndFillsTheGap) {
  const std::vector<Curve> curves = {CurveAt({1, 2}), CurveAt({4, 5})};
  // The head of a curve is the end at which it arrives.
  const EndTies ties = Tied(2, {{Head(0), Tail(1)}});
  const auto strung = StringTogether(curves, ties, Middle);
  ASSERT_EQ(strung.size(), 1u);
  EXPECT_FALSE(strung[0].closed);
  EXPECT_EQ(PlacesOf(strung[0]), (Places{1, 2, 3, 4, 5}));
  EXPECT_EQ(PlacesOf(StringTogether(curves, ties, {})[0]),
            (Places{1, 2, 4, 5}));
}

TEST(StringTogether, RunsThroughFlippedCurvesFromTheirEnds) {
  const auto strung = StringTogether({CurveAt({1, 2}), CurveAt({5, 4})},
                                     Tied(2, {{Head(0), Head(1)}}),
                                     Middle);
  ASSERT_EQ(strung.size(), 1u);
  EXPECT_EQ(PlacesOf(strung[0]), (Places{1, 2, 3, 4, 5}));
  for (const CurveSample& sample : strung[0].samples) {
    EXPECT_EQ(sample.tangent.x(), 1);
  }
}

TEST(StringTogether, FillsTheGapOfARingToo) {
  const auto strung =
      StringTogether({CurveAt({1, 2, 7})}, Tied(1, {{0, 1}}), Middle);
  ASSERT_EQ(strung.size(), 1u);
  EXPECT_TRUE(strung[0].closed);
  EXPECT_EQ(PlacesOf(strung[0]), (Places{1, 2, 7, 4}));
}

std::vector<Places> PlacesOf(const std::vector<Curve>& curves) {
  std::vector<Places> places;
  for (const Curve& curve : curves) places.push_back(PlacesOf(curve));
  return places;
}

TEST(CutAfter, PiecesEndWithTheSamples) {
  const Curve curve = CurveAt({0, 1, 2, 3, 4});
  EXPECT_EQ(PlacesOf(CutAfter(curve, {})),
            (std::vector<Places>{{0, 1, 2, 3, 4}}));
  EXPECT_EQ(PlacesOf(CutAfter(curve, {1, 3})),
            (std::vector<Places>{{0, 1}, {2, 3}, {4}}));
  EXPECT_EQ(PlacesOf(CutAt(curve, {1, 3})),
            (std::vector<Places>{{0, 1}, {1, 2, 3}, {3, 4}}));
}

TEST(CutAfter, AClosedCurveIsOpened) {
  Curve curve = CurveAt({0, 1, 2, 3, 4});
  curve.closed = true;
  EXPECT_TRUE(CutAt(curve, {})[0].closed);
  EXPECT_FALSE(CutAt(curve, {2})[0].closed);
  EXPECT_EQ(PlacesOf(CutAfter(curve, {2})),
            (std::vector<Places>{{3, 4, 0, 1, 2}}));
  EXPECT_EQ(PlacesOf(CutAt(curve, {2})),
            (std::vector<Places>{{2, 3, 4, 0, 1, 2}}));
  EXPECT_EQ(PlacesOf(CutAt(curve, {1, 4})),
            (std::vector<Places>{{1, 2, 3, 4}, {4, 0, 1}}));
}

}  // namespace
}  // namespace curvix
