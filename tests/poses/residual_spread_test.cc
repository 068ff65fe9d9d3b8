// SPDX-License-Identifier: BSD-3-Clause
#include "poses/pose_search_estimates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random.h"

namespace curvix {
namespace {

std::vector<double> Distances(double sigma_px, double share, double gate_px) {
  Random random(5);
  std::vector<double> distances;
  for (int i = 0; i < 2000; ++i) {
    distances.push_back(random.Uniform() < share
                            ? std::abs(sigma_px * random.Normal())
                            : random.Uniform(0, gate_px));
  }
  return distances;
}

TEST(FitSpread, SeesTheCurvesOwnEdgesAmongOthers) {
  EXPECT_NEAR(FitSpread(Distances(0.1, 0.6, 4), 4), 0.1, 0.02);
  EXPECT_NEAR(FitSpread(Distances(0.8, 0.8, 4), 4), 0.8, 0.15);
}

TEST(FitSpread, IsWideWhereNothingIsInPlace) {
  EXPECT_GT(FitSpread(Distances(1, 0, 4), 4), 0.5);
}

TEST(FitSpread, IsNotNothing) {
  EXPECT_EQ(FitSpread(std::vector<double>(50, 0.0), 4), 0.05);
}

}  // namespace
}  // namespace curvix
