// SPDX-License-Identifier: BSD-3-Clause
// Which fits leave their groups.
#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "fitting/structure.h"
#include "gtest/gtest.h"

namespace curvix {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

CurveFit LineFit(const Vector3d& start, const Vector3d& end, double sigma) {
  CurveFit fit;
  fit.start = start;
  fit.end = end;
  fit.sigma = sigma;
  fit.start_covariance = fit.end_covariance =
      sigma * sigma * Matrix3d::Identity();
  return fit;
}

// A curve of one fit, which is parallel to x.
void AddParallel(const CurveFit& fit, FittedCurves& fitted) {
  if (fitted.structure.groups.empty()) {
    fitted.structure.groups.emplace_back().direction = Vector3d::UnitX();
  }
  fitted.structure.groups[0].fits.push_back({fitted.curves.size(), 0});
  fitted.curves.push_back({{fit}});
}

void ExpectParallel(const FittedCurves& fitted) {
  const FitGroup& group = fitted.structure.groups.at(0);
  for (const FitIndex& i : group.fits) {
    const CurveFit& fit = fitted.curves[i.curve_idx].fits[i.fit_idx];
    const Vector3d along = (fit.end - fit.start).normalized();
    EXPECT_LT(along.cross(group.direction).norm(), 1e-6) << i.curve_idx;
  }
}

// Five lines of one direction and one that is 50 standard deviations off. The
// mean direction of all is four off from each of the five.
TEST(Regularize, KeepsLinesThatOneBadLineMoves) {
  constexpr double kEndSigma = 0.001;
  FittedCurves fitted;
  for (int y = 0; y < 5; ++y) {
    AddParallel(LineFit({0, 1.0 * y, 0}, {1, 1.0 * y, 0}, kEndSigma), fitted);
  }
  AddParallel(LineFit({0, 5, 0}, {1, 5.05, 0}, kEndSigma), fitted);
  Regularize(fitted);
  ASSERT_EQ(fitted.structure.groups.size(), 1u);
  EXPECT_EQ(fitted.structure.groups[0].fits.size(), 5u);
  ExpectParallel(fitted);
}

// Lines 0 and 1 and the start of line 2 are sure; the end of line 2 is to move
// by one standard deviation. The arc that goes on there is in no group and
// would move by more than four of its own.
FittedCurves ArcOnALine() {
  constexpr double kSure = 1e-5, kEndArcSigma = 3e-4, kMove = 0.002;
  FittedCurves fitted;
  AddParallel(LineFit({0, 0, 0}, {1, 0, 0}, kSure), fitted);
  AddParallel(LineFit({0, 1, 0}, {1, 1, 0}, kSure), fitted);
  CurveFit line = LineFit({0, 2, 0}, {1, 2 + kMove, 0}, kSure);
  line.end_node = 0;
  line.end_covariance = kMove * kMove * Matrix3d::Identity();
  AddParallel(line, fitted);
  CurveFit arc;
  arc.kind = FitKind::kArc;
  arc.center = {1, 3 + kMove, 0};
  arc.start = line.end;
  arc.end = arc.center + Vector3d::UnitX();
  arc.start_angle = -kPi / 2;
  arc.sigma = kEndArcSigma;
  arc.start_node = 0;
  arc.arc_covariance.diagonal().setConstant(kEndArcSigma * kEndArcSigma);
  fitted.curves.push_back({{arc}});
  fitted.nodes.push_back(
      {line.end, {{2, 0, true}, {3, 0, false}}, line.end_covariance});
  return fitted;
}

TEST(Regularize, LinesLeaveTheirGroupIfAnArcOnThemWouldMoveTooFar) {
  FittedCurves fitted = ArcOnALine();
  Regularize(fitted);
  ASSERT_EQ(fitted.structure.groups.size(), 1u);
  EXPECT_EQ(fitted.structure.groups[0].fits.size(), 2u);
  ExpectParallel(fitted);
  const FittedCurves before = ArcOnALine();
  EXPECT_LT((fitted.nodes[0].position - before.nodes[0].position).norm(), 1e-6);
  EXPECT_LT((fitted.curves[3].fits[0].center - before.curves[3].fits[0].center)
                .norm(),
            1e-6);
}

}  // namespace
}  // namespace curvix
