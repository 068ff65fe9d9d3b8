// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/fitting.h>

#include <Eigen/Dense>
#include <cmath>
#include <optional>

#include "gtest/gtest.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kBoxSigma = 0.001;

// Three edges of a box that meet at the origin; independent errors. A sample is
// better known along z than across it, as depth is worse than the image.
CurveSet Corner(Random& random) {
  CurveSet set;
  for (int axis = 0; axis < 3; ++axis) {
    Curve& curve = set.curves.emplace_back();
    const Vector3d along = Vector3d::Unit(axis);
    const Matrix3d across = Matrix3d::Identity() - along * along.transpose();
    for (int i = 0; i <= 60; ++i) {
      CurveSample& s = curve.samples.emplace_back();
      s.tangent = along;
      s.position = i / 60.0 * along;
      const Vector3d sigmas = kBoxSigma * across * Vector3d(1, 1, 0.2);
      s.covariance = sigmas.cwiseAbs2().asDiagonal();
      s.sigma = std::sqrt(s.covariance.trace() / 2);
      if (i > 0) s.position += sigmas.cwiseProduct(random.NormalVector());
    }
  }
  return set;
}

std::optional<CurveNode> NodeOf(const CurveSet& curves) {
  const FittedCurves fitted = FitCurves(curves, {}, {}, 1);
  if (fitted.nodes.size() != 1) return std::nullopt;
  return fitted.nodes.front();
}

TEST(NodeCovariance, ErrorsAreAsLargeAsStated) {
  constexpr int kNumSeeds = 60;
  double sum = 0;
  Vector3d variances = Vector3d::Zero();
  for (int seed = 0; seed < kNumSeeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const auto node = NodeOf(Corner(random));
    ASSERT_TRUE(node);
    const Vector3d e = node->position;
    sum += e.dot(node->covariance.inverse() * e) / 3;
    variances += node->covariance.diagonal() / kNumSeeds;
  }
  EXPECT_GT(sum / kNumSeeds, 0.3);
  EXPECT_LT(sum / kNumSeeds, 2);
  EXPECT_LT(variances.z(), variances.x());
}

TEST(NodeCovariance, FreeEndsAreUncertainAlongTheLine) {
  Random random(5);
  const FittedCurves fitted = FitCurves(Corner(random), {}, {}, 1);
  const CurveFit& fit = fitted.curves[0].fits[0];
  ASSERT_EQ(fit.kind, FitKind::kLine);
  ASSERT_EQ(fit.start_node, 0);
  EXPECT_EQ(fit.end_node, -1);
  EXPECT_EQ(fit.start_covariance, fitted.nodes[0].covariance);
  EXPECT_GT(fit.end_covariance(0, 0), fit.end_covariance(1, 1));
  EXPECT_GT(fit.end_covariance(1, 1), 0);
}

}  // namespace
}  // namespace curvix
