// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/refine_curves.h"

#include <gtest/gtest.h>

#include "tests/curve_refinement/seen_curves.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

constexpr double kNoisePx = 0.3;

SeenCurve SeeFromEightViews(Curve curve) {
  return SeeFrom(EightViews(), std::move(curve));
}

Curve Noisy(Curve curve, double noise_px = kNoisePx) {
  Random random(11);
  for (CurveSample& sample : curve.samples) {
    sample.position += noise_px * kPixel * random.Across(sample.tangent);
  }
  return curve;
}

std::vector<Curve> FitAll(const SeenCurve& seen,
                          double smoothing_px = 2.5,
                          double noise_px = kNoisePx) {
  CurveRefinementOptions options;
  options.smoothing_px = smoothing_px;
  return FitToImages({Noisy(seen.truth, noise_px)},
                     {seen.views, seen.edge_maps, kEdgeSigmaPx, options, 1},
                     {});
}

// The only curve.
Curve Fit(const SeenCurve& seen, double smoothing_px = 2.5) {
  std::vector<Curve> curves = FitAll(seen, smoothing_px);
  EXPECT_EQ(curves.size(), 1);
  return curves.at(0);
}

TEST(FitToImages, CirclesComeBackAndDoNotShrink) {
  for (const double radius_px : {30.0, 100.0}) {
    const SeenCurve seen =
        SeeFromEightViews(Arc(radius_px, 0, 2 * std::numbers::pi));
    for (const CurveSample& sample : Fit(seen).samples) {
      EXPECT_NEAR(sample.position.norm() / kPixel, radius_px, 0.08);
      EXPECT_NEAR(sample.position.y() / kPixel, 0, 0.25);  // the depth
      EXPECT_NEAR(sample.tangent.dot(sample.position.normalized()), 0, 0.05);
    }
  }
}

// So far away the gradient of the loss falls with the distance.
TEST(FitToImages, SamplesThatAreTenSigmasOffComeBack) {
  const SeenCurve seen = SeeFromEightViews(Arc(100, 0, 2 * std::numbers::pi));
  const std::vector<Curve> fitted = FitAll(seen, 2.5, 10 * kEdgeSigmaPx);
  ASSERT_EQ(fitted.size(), 1);
  for (const CurveSample& sample : fitted[0].samples) {
    EXPECT_NEAR(sample.position.norm() / kPixel, 100, 0.08);
  }
}

TEST(FitToImages, BlurDoesNotShrinkCircles) {
  const double radius_px = 30;
  const double blur_px = 1.2;
  SeenCurve blurred =
      SeeFromEightViews(Arc(radius_px - blur_px * blur_px / (2 * radius_px),
                            0,
                            2 * std::numbers::pi));
  for (EdgeMap& map : blurred.edge_maps) {
    for (Edge2d& edge : map.edges) {
      edge.sharpness = static_cast<float>(1 / (blur_px * blur_px));
    }
  }
  double sum = 0;
  const Curve fitted = Fit(blurred);
  for (const CurveSample& sample : fitted.samples) {
    sum += sample.position.norm();
  }
  EXPECT_NEAR(sum / kPixel / static_cast<double>(fitted.samples.size()),
              radius_px,
              0.005);
}

TEST(FitToImages, NoiseOfTheImagesIsSmoothedAway) {
  SeenCurve seen = SeeFromEightViews(Line(InPlane(-50, 0), InPlane(50, 0)));
  Random random(2);
  for (EdgeMap& map : seen.edge_maps) {
    for (Edge2d& edge : map.edges) {
      edge.position += 0.15 * random.NormalVector().head<2>();
    }
  }
  const Curve fitted = Fit(seen);
  const Curve rough = Fit(seen, 0.2);
  double angle = 0, rough_angle = 0;
  for (std::size_t k = 5; k + 5 < fitted.samples.size(); ++k) {
    angle += fitted.samples[k].tangent.tail<2>().norm();
    rough_angle += rough.samples[k].tangent.tail<2>().norm();
  }
  EXPECT_LT(angle, 0.6 * rough_angle);
}

TEST(FitToImages, ACornerIsNotRounded) {
  Curve corner = Line(InPlane(-40, 0), InPlane(0, 0));
  const Curve other = Line(InPlane(0, 1), InPlane(0, 40));
  corner.samples.insert(
      corner.samples.end(), other.samples.begin(), other.samples.end());
  const SeenCurve seen = SeeFromEightViews(corner);
  const Curve fitted = Fit(seen);
  for (std::size_t k = 0; k < fitted.samples.size(); ++k) {
    EXPECT_LT((fitted.samples[k].position - corner.samples[k].position).norm(),
              0.4 * kPixel)
        << k;
  }
}

TEST(FitToImages, WrongEdgesHardlyPull) {
  SeenCurve seen = SeeFromEightViews(Line(InPlane(-50, 0), InPlane(50, 0)));
  for (Edge2d& edge : seen.edge_maps[3].edges) edge.position.y() += 1;
  for (const CurveSample& sample : Fit(seen).samples) {
    EXPECT_LT(sample.position.tail<2>().norm(), 0.1 * kPixel);
  }
}

TEST(FitToImages, SamplesBetweenContradictoryEdgesAreCutOut) {
  SeenCurve seen = SeeFromEightViews(Line(InPlane(-50, 0), InPlane(50, 0)));
  const std::size_t size = seen.truth.samples.size();
  const std::size_t begin = size / 3, end = begin + 5;
  for (std::size_t k = begin; k < end; ++k) {
    for (const EdgeRef& ref : seen.truth.samples[k].support) {
      const auto v = static_cast<std::size_t>(ref.view_idx);
      seen.edge_maps[v]
          .edges[static_cast<std::size_t>(ref.edge_idx)]
          .position.y() += v % 2 == 0 ? 8 : -8;
    }
  }
  const std::vector<Curve> parts = FitAll(seen);
  ASSERT_EQ(parts.size(), 2);
  EXPECT_EQ(parts[0].samples.size(), begin);
  EXPECT_EQ(parts[1].samples.size(), size - end);
}

TEST(FitToImages, NoWidthMovesNothing) {
  const SeenCurve seen = SeeFromEightViews(Arc(30, 0, 2));
  EXPECT_EQ(LargestDistance({Fit(seen, 0)}, {Noisy(seen.truth)}), 0);
}

TEST(FitToImages, DoesNotDependOnTheUnit) {
  const double factor = 1000;
  const SeenCurve seen = SeeFromEightViews(Arc(40, 0, 3));
  const std::vector<Curve> noisy = {Noisy(seen.truth)};
  const std::vector<Curve> fitted =
      FitToImages(noisy, {seen.views, seen.edge_maps, kEdgeSigmaPx, {}, 1}, {});
  const std::vector<Curve> large = FitToImages(
      Scaled(noisy, factor),
      {Scaled(seen.views, factor), seen.edge_maps, kEdgeSigmaPx, {}, 1},
      {});
  EXPECT_LT(LargestDistance(large, Scaled(fitted, factor)), 1e-6 * factor);
}

}  // namespace
}  // namespace curvix
