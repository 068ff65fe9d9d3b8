// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/refine_curves.h"

#include <gtest/gtest.h>

#include "tests/curve_refinement/drawn_curves.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

constexpr CurveRefinementOptions kSmoothOptions = {.smoothing_px = 2.5};

std::vector<Curve> Smooth(
    const std::vector<Curve>& curves,
    const std::vector<PosedView>& views = FrontalViews(),
    const CurveRefinementOptions& options = kSmoothOptions,
    int num_threads = 1) {
  return SmoothCurves(curves, {views, {}, kEdgeSigmaPx, options, num_threads});
}

Curve WithNoise(Curve curve, double noise_px) {
  Random random(7);
  for (CurveSample& sample : curve.samples) {
    sample.position += noise_px * kPixel * random.Across(sample.tangent);
  }
  return curve;
}

// Root mean square of the distances from the line z = 0. Pixels.
double DistanceFromLine(const Curve& curve) {
  double sum = 0;
  for (const CurveSample& sample : curve.samples) {
    sum += sample.position.tail<2>().squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(curve.samples.size())) / kPixel;
}

const Curve& LongLine() {
  static const Curve line = Line(InPlane(-50, 0), InPlane(50, 0));
  return line;
}

TEST(SmoothCurves, KeepsALine) {
  const std::vector<Curve> smooth = Smooth({LongLine()});
  EXPECT_LT(LargestDistance(smooth, {LongLine()}), 1e-12);
  for (const CurveSample& sample : smooth[0].samples) {
    EXPECT_LT((sample.tangent - Eigen::Vector3d::UnitX()).norm(), 1e-9);
  }
}

TEST(SmoothCurves, KeepsTheRadiusOfACircle) {
  for (const double end : {2 * std::numbers::pi, std::numbers::pi}) {
    const std::vector<Curve> smooth = Smooth({Arc(30, 0, end)});
    for (const CurveSample& sample : smooth[0].samples) {
      EXPECT_NEAR(sample.position.norm() / kPixel, 30, 0.05);
      EXPECT_NEAR(sample.tangent.dot(sample.position.normalized()), 0, 0.02);
    }
  }
}

TEST(SmoothCurves, TakesNoiseAway) {
  const Curve noisy = WithNoise(LongLine(), 0.3);
  const Curve smooth = Smooth({noisy})[0];
  EXPECT_LT(DistanceFromLine(smooth), 0.6 * DistanceFromLine(noisy));
  // Ends are less sure of their direction.
  for (std::size_t k = 8; k + 8 < smooth.samples.size(); ++k) {
    EXPECT_LT(smooth.samples[k].tangent.tail<2>().norm(), 0.2);
  }
}

TEST(SmoothCurves, SurerSamplesCountMore) {
  Curve curve = LongLine();
  curve.samples[50].position += InPlane(0, 5);
  const double pulled = DistanceFromLine(Smooth({curve})[0]);
  curve.samples[50].sigma *= 1e4;
  EXPECT_LT(DistanceFromLine(Smooth({curve})[0]), 1e-3 * pulled);
}

TEST(SmoothCurves, LeavesTheRestOfASampleAlone) {
  const Curve noisy = WithNoise(LongLine(), 0.3);
  const Curve smooth = Smooth({noisy})[0];
  ASSERT_EQ(smooth.samples.size(), noisy.samples.size());
  for (std::size_t k = 0; k < smooth.samples.size(); ++k) {
    EXPECT_EQ(smooth.samples[k].sigma, noisy.samples[k].sigma);
    EXPECT_EQ(smooth.samples[k].evidence, noisy.samples[k].evidence);
    EXPECT_EQ(smooth.samples[k].support, noisy.samples[k].support);
  }
}

TEST(SmoothCurves, ShortCurvesStay) {
  Curve curve = WithNoise(LongLine(), 0.3);
  curve.samples.resize(4);
  EXPECT_EQ(LargestDistance(Smooth({curve}), {curve}), 0);
  EXPECT_TRUE(Smooth({}).empty());
}

TEST(SmoothCurves, NoWidthMovesNothing) {
  CurveRefinementOptions options = kSmoothOptions;
  options.smoothing_px = 0;
  const std::vector<Curve> noisy = {WithNoise(LongLine(), 0.3)};
  EXPECT_EQ(LargestDistance(Smooth(noisy, FrontalViews(), options), noisy), 0);
}

TEST(SmoothCurves, ThreadsChangeNothing) {
  std::vector<Curve> noisy;
  for (int i = 1; i < 8; ++i) {
    noisy.push_back(WithNoise(Arc(10 * i, 0, 3), 0.1 * i));
  }
  EXPECT_EQ(LargestDistance(Smooth(noisy, FrontalViews(), kSmoothOptions, 3),
                            Smooth(noisy)),
            0);
}

TEST(SmoothCurves, DoesNotDependOnTheUnit) {
  const double factor = 1000;
  const std::vector<Curve> noisy = {WithNoise(Arc(40, 0, 4), 0.2)};
  const std::vector<Curve> smooth =
      Smooth(Scaled(noisy, factor), Scaled(FrontalViews(), factor));
  EXPECT_LT(LargestDistance(smooth, Scaled(Smooth(noisy), factor)),
            1e-9 * factor);
}

}  // namespace
}  // namespace curvix
