// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/fitting.h>

#include "gtest/gtest.h"
#include "tests/fitting/sampled_curves.h"

namespace curvix {
namespace {

using Eigen::Vector3d;

// A short line along x that ends in 0, and a long one that is known ten times
// worse and crosses x at `crossing`. Their ends share a sample.
FittedCurves ShortBesideLong(double crossing) {
  Curve one = Sample(
      [](double t) { return Vector3d(0.05 * (t - 1), 0, 0); }, 30, false, 0);
  Curve two =
      Sample([&](double t) { return Vector3d(t, 0.1 * (t - crossing), 0); },
             60,
             false,
             0);
  for (CurveSample& s : two.samples) s.sigma = 10 * kSigma;
  two.samples.front().position = one.samples.back().position;
  return Fit({one, two});
}

TEST(MeetInNodes, LinesRunFromTheirFirstToTheirLastSample) {
  for (const double crossing : {-0.09, -0.06, -0.03, 0.03, 0.09}) {
    const FittedCurves fitted = ShortBesideLong(crossing);
    ASSERT_EQ(fitted.nodes.size(), 1u) << crossing;
    const CurveFit& fit = fitted.curves[0].fits.at(0);
    ASSERT_EQ(KindName(fit), "line");
    EXPECT_EQ(fit.end, fitted.nodes[0].position);
    EXPECT_LT((fit.end - Vector3d::Zero()).norm(), kSigma) << crossing;
    EXPECT_NEAR(fit.end.x() - fit.start.x(), 0.05, kSigma) << crossing;
  }
}

TEST(MeetInNodes, LinesMeetWhereTheyCrossNearTheirEnds) {
  const FittedCurves fitted = ShortBesideLong(-0.01);
  ASSERT_EQ(fitted.nodes.size(), 1u);
  EXPECT_NEAR(fitted.nodes[0].position.x(), -0.01, 0.003);
}

}  // namespace
}  // namespace curvix
