// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/grow_curves.h"

#include <gtest/gtest.h>
#include <cstddef>
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
  // Edges of this strength and crowding.
  std::vector<Curve> Keep(const std::vector<GrownCurve>& curves,
                          double min_significance,
                          const std::vector<float>& strengths = {1, 1},
                          const std::vector<float>& crowding = {0, 0}) {
    map_.edges.resize(strengths.size());
    for (std::size_t i = 0; i < strengths.size(); ++i) {
      map_.edges[i].strength = strengths[i];
      map_.edges[i].crowding = Eigen::half(crowding[i]);
    }
    ViewIndex index;
    index.edges = &map_;
    options_.min_significance = min_significance;
    return KeepSignificant(curves, {index}, options_);
  }

  CurveGrowthOptions options_;

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

TEST_F(KeepSignificantTest, DropsTextureThatIsNotFourTimesAsSignificant) {
  const std::vector<GrownCurve> curves = {Grown(8, 5, 16, 0),
                                          Grown(8, 5, 16, 1)};
  options_.max_crowding = 0.375;
  const std::vector<Curve> kept = Keep(curves, 2.51, {1, 1}, {0.375, 0.5});
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0].samples[0].support[0].edge_idx, 0);
  EXPECT_EQ(Keep(curves, 2.49, {1, 1}, {0.375, 0.5}).size(), 2u);
  options_.max_crowding = 0;
  EXPECT_EQ(Keep(curves, 9, {1, 1}, {0.375, 0.5}).size(), 2u)
      << "nothing is texture";
}

TEST(MedianCrowding, IsThatOfTheEdges) {
  EdgeMap map;
  for (const float crowding : {0.5F, 0.25F, 4.0F}) {
    map.edges.emplace_back().crowding = Eigen::half(crowding);
  }
  ViewIndex index;
  index.edges = &map;
  EXPECT_EQ(MedianCrowding({{0, 0}, {0, 1}, {0, 2}}, {index}), 0.5);
  EXPECT_EQ(MedianCrowding({}, {index}), 0);
}

TEST_F(KeepSignificantTest, AtZeroKeepsAllInTheirOrder) {
  const std::vector<Curve> kept = Keep({Grown(2, 0, 0), Grown(3, 1, 1)}, 0);
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[0].samples.size(), 2u);
}

}  // namespace
}  // namespace curvix
