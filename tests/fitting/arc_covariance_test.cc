// SPDX-License-Identifier: BSD-3-Clause
#include <curvix/fitting.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "fitting/end_covariance.h"
#include "fitting/primitive.h"
#include "gtest/gtest.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

using Eigen::Vector3d;
constexpr double kArcSigma = 0.001;
constexpr double kRadius = 0.4;
const Vector3d kArcCenter(0.3, -0.2, 0.5);

// One curve: a line, the arc of `sweep` that goes on from it, a line. With a
// corner of a quarter turn at both joints, or smoothly.
CurveSet ArcBetweenLines(double sweep, bool has_corners, Random& random) {
  std::vector<Vector3d> points;
  const auto on_arc = [&](double t) -> Vector3d {
    return kArcCenter + kRadius * Vector3d(std::cos(t), std::sin(t), 0);
  };
  const auto along = [&](double t) -> Vector3d {
    return has_corners ? Vector3d(std::cos(t), std::sin(t), 0)
                       : Vector3d(-std::sin(t), std::cos(t), 0);
  };
  constexpr int kSteps = 60;
  const double step = kRadius * sweep / kSteps;
  for (int i = kSteps; i > 0; --i) {
    points.push_back(on_arc(0) - i * step * (has_corners ? -1 : 1) * along(0));
  }
  for (int i = 0; i <= kSteps; ++i)
    points.push_back(on_arc(sweep * i / kSteps));
  for (int i = 1; i <= kSteps; ++i) {
    points.push_back(on_arc(sweep) + i * step * along(sweep));
  }
  CurveSet set;
  Curve& curve = set.curves.emplace_back();
  for (std::size_t i = 0; i < points.size(); ++i) {
    CurveSample& s = curve.samples.emplace_back();
    const std::size_t next = std::min(i + 1, points.size() - 1);
    s.tangent = (points[next] - points[i > 0 ? i - 1 : 0]).normalized();
    const Eigen::Matrix3d across =
        Eigen::Matrix3d::Identity() - s.tangent * s.tangent.transpose();
    s.position = points[i] + kArcSigma * across * random.NormalVector();
    s.sigma = kArcSigma;
  }
  return set;
}

// Root mean square of the errors of radius and centre in standard deviations.
Eigen::Array2d Normalised(double sweep, bool has_corners) {
  constexpr int kNumSeeds = 80;
  double radius = 0, center = 0;
  int num_arcs = 0;
  for (int seed = 0; seed < kNumSeeds; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const FittedCurves fitted =
        FitCurves(ArcBetweenLines(sweep, has_corners, random), {}, {}, 1);
    for (const CurveFit& fit : fitted.curves[0].fits) {
      if (fit.kind != FitKind::kArc || fit.major.norm() > 2 * kRadius) continue;
      ++num_arcs;
      const double error = fit.major.norm() - kRadius;
      radius += std::pow(error / fit.radius_sigma, 2);
      const Vector3d off = fit.center - kArcCenter;
      const Eigen::Matrix3d covariance =
          fit.arc_covariance.topLeftCorner<3, 3>();
      center += off.dot(covariance.ldlt().solve(off)) / 3;
    }
  }
  EXPECT_GT(num_arcs, 0.8 * kNumSeeds);
  return Eigen::Array2d(radius / num_arcs, center / num_arcs).sqrt();
}

TEST(ArcCovariance, ErrorsInAChainAreAsLargeAsStated) {
  for (const bool has_corners : {false, true}) {
    for (const double sweep : {kPi / 2, kPi}) {
      const Eigen::Array2d normalised = Normalised(sweep, has_corners);
      EXPECT_GT(normalised.minCoeff(), 0.5) << sweep << has_corners;
      EXPECT_LT(normalised.maxCoeff(), 1.7) << sweep << has_corners;
    }
  }
}

// An arc of chord 2 between two points that are known has a bow of 1 / (2 R).
// That of n samples of standard deviation s, at x from -1 to 1, is known to
// s / sqrt(sum (1 - x^2)^2), which is s / sqrt(8 n / 15).
TEST(ArcCovariance, KnowsTheRadiusOfAnArcThatIsNearlyStraight) {
  constexpr int kNumSamples = 201;
  const double bow_sigma = kArcSigma / std::sqrt(8 * kNumSamples / 15.0);
  for (const double radius : {10.0, 1e2, 1e3, 9e3}) {
    for (const Vector3d& origin : {Vector3d(0, 0, 0), Vector3d(5e5, 5e6, 0)}) {
      Conic arc;
      arc.center = origin;
      arc.a = arc.b = radius;
      FitSamples samples;
      for (int i = 0; i < kNumSamples; ++i) {
        const double x = 2.0 * i / (kNumSamples - 1) - 1;
        samples.push_back({arc.At(0.7 + std::asin(x / radius)),
                           kArcSigma,
                           0,
                           0,
                           Eigen::Matrix3d::Zero()});
      }
      const Eigen::Matrix3d sure = Eigen::Matrix3d::Zero();
      const auto covariance = ArcCovariance(
          arc,
          samples,
          {{samples.front().position, sure}, {samples.back().position, sure}},
          false);
      const double expected = 2 * radius * radius * bow_sigma;
      EXPECT_NEAR(std::sqrt(covariance(6, 6)), expected, 0.02 * expected)
          << radius << " " << origin.transpose();
      EXPECT_GE(covariance.diagonal().minCoeff(), 0);
    }
  }
}

// Nodes may be ten standard deviations off, which is most of the bow of a
// shallow arc, and beyond it.
TEST(FitThrough, ReachesNodesThatAreFarFromAShallowArc) {
  Conic arc;
  arc.a = arc.b = kRadius;
  FitSamples samples;
  for (int i = 0; i <= 50; ++i) {
    samples.push_back(
        {arc.At(0.01 * i), kArcSigma, 0, 0, Eigen::Matrix3d::Zero()});
  }
  for (const double move : {-0.02, -0.012, 0.005, 0.02}) {
    for (const Vector3d& aside : {Vector3d(0, 0, 0), Vector3d(0, 0, 0.01)}) {
      const Vector3d start = (1 + move / kRadius) * arc.At(0) + aside;
      const Vector3d end = (1 + move / kRadius) * arc.At(0.5);
      const auto through = FitThrough(arc, samples, start, end);
      ASSERT_TRUE(through) << move;
      for (const Vector3d& node : {start, end}) {
        const Vector3d foot = through->At(NearestParameter(*through, node));
        EXPECT_LT((foot - node).norm(), 0.1 * kArcSigma) << move;
      }
      EXPECT_EQ(through->a, through->b);
    }
  }
}

}  // namespace
}  // namespace curvix
