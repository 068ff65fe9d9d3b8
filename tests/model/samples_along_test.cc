// SPDX-License-Identifier: BSD-3-Clause
#include "model/sample_ranges.h"

#include <gtest/gtest.h>

#include <vector>

namespace curvix {
namespace {

using Indices = std::vector<std::size_t>;

Curve CurveOfLength(int length) {
  Curve curve;
  for (int i = 0; i <= length; ++i) {
    curve.samples.emplace_back().position = {1.0 * i, 0, 0};
  }
  return curve;
}

TEST(SamplesAlong, AreInTheMiddleOfEqualParts) {
  EXPECT_EQ(SamplesAlong(CurveOfLength(12), 4), (Indices{2, 6, 10}));
  EXPECT_EQ(SamplesAlong(CurveOfLength(15), 4), (Indices{3, 8, 13}));
}

TEST(SamplesAlong, AreNoMoreThanAsked) {
  EXPECT_EQ(SamplesAlong(CurveOfLength(12), 1, 3), (Indices{2, 6, 10}));
}

TEST(SamplesAlong, OfAShortCurveIsTheMiddle) {
  EXPECT_EQ(SamplesAlong(CurveOfLength(2), 100), (Indices{1}));
  EXPECT_EQ(SamplesAlong(CurveOfLength(0), 100), (Indices{0}));
}

TEST(SamplesAlong, DoNotRepeatWhereSamplesAreSparse) {
  EXPECT_EQ(SamplesAlong(CurveOfLength(2), 0.1), (Indices{1, 2}));
}

}  // namespace
}  // namespace curvix
