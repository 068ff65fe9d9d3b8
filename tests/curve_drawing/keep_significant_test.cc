// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/keep_significant.h"

#include <gtest/gtest.h>
#include <cstdint>
#include <vector>

namespace curvix {
namespace {

// Samples on the edge `edge_idx` of the only view.
GrownCurve Grown(std::size_t num_samples,
                 double evidence,
                 std::int64_t num_looks,
                 std::int32_t edge_idx = 0) {
  GrownCurve grown;
  grown.num_looks = num_looks;
  grown.curve.samples.resize(num_samples);
  for (CurveSample& sample : grown.curve.samples) {
    sample.evidence = evidence;
    sample.support = {{0, edge_idx}};
  }
  return grown;
}

class KeepSignificantTest : public ::testing::Test {
 protected:
  // Edges of these strengths.
  std::vector<Curve> Keep(const std::vector<GrownCurve>& curves,
                          double min_significance,
                          const std::vector<float>& strengths = {1, 1}) {
    map_.edges.clear();
    for (const float strength : strengths) {
      map_.edges.emplace_back().strength = strength;
    }
    ViewIndex index;
    index.edges = &map_;
    CurveGrowthOptions options;
    options.min_significance = min_significance;
    return KeepSignificant(curves, {index}, options);
  }

 private:
  EdgeMap map_;
};

TEST_F(KeepSignificantTest, ComparesTheSumWithTheRootOfTheLooks) {
  // 8 * 5 / sqrt(16) = 10.
  EXPECT_EQ(Keep({Grown(8, 5, 16)}, 9.99).size(), 1u);
  EXPECT_TRUE(Keep({Grown(8, 5, 16)}, 10.01).empty());
}

TEST_F(KeepSignificantTest, WeighsByContrast) {
  const std::vector<GrownCurve> curves = {Grown(8, 5, 16, 0),
                                          Grown(8, 5, 16, 1)};
  const std::vector<Curve> kept = Keep(curves, 9, {30, 10});
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0].samples[0].support[0].edge_idx, 0);
  EXPECT_EQ(Keep(curves, 4.9, {30, 10}).size(), 2u);
}

TEST_F(KeepSignificantTest, DoesWithoutStrengths) {
  EXPECT_EQ(Keep({Grown(8, 5, 16)}, 9.99, {0, 0}).size(), 1u);
  EXPECT_TRUE(Keep({}, 0).empty());
}

TEST_F(KeepSignificantTest, AtZeroKeepsAllInTheirOrder) {
  const std::vector<Curve> kept = Keep({Grown(2, 0, 0), Grown(3, 1, 1)}, 0);
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[0].samples.size(), 2u);
}

}  // namespace
}  // namespace curvix
