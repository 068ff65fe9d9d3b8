// SPDX-License-Identifier: BSD-3-Clause
#include "poses/pose_search_estimates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random.h"

namespace curvix {
namespace {

// Samples of curves in all directions whose picture is shifted, and edges
// anywhere besides.
std::vector<EdgesAround> Shifted(const Eigen::Vector2d& shift,
                                 double share_seen) {
  Random random(3);
  std::vector<EdgesAround> samples;
  for (int i = 0; i < 200; ++i) {
    const double angle = random.Uniform(0, 3.14159);
    EdgesAround sample;
    sample.normal = {std::cos(angle), std::sin(angle)};
    if (random.Uniform() < share_seen) {
      sample.distances_px.push_back(sample.normal.dot(shift));
    }
    sample.distances_px.push_back(random.Uniform(-6, 6));
    samples.push_back(sample);
  }
  return samples;
}

TEST(FindShift, FindsWhereMostSamplesAgree) {
  const Eigen::Vector2d shift(2.8, -4.3);
  EXPECT_LT((FindShift(Shifted(shift, 0.6), 6) - shift).norm(), 0.3);
}

TEST(FindShift, LeavesAPictureThatIsInPlace) {
  const Eigen::Vector2d none = Eigen::Vector2d::Zero();
  EXPECT_EQ(FindShift(Shifted(none, 0.6), 6), none);
}

TEST(FindShift, DoesNotFollowChance) {
  EXPECT_EQ(FindShift(Shifted({3, 3}, 0), 6), Eigen::Vector2d::Zero());
  EXPECT_EQ(FindShift({}, 6), Eigen::Vector2d::Zero());
}

}  // namespace
}  // namespace curvix
