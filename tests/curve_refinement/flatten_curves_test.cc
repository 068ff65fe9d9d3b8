// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "curve_refinement/refine_curves.h"
#include "tests/curve_refinement/seen_curves.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

// By a camera that moves along the x axis, up and down by a little.
std::vector<PosedView> ViewsAlongX() {
  std::vector<PosedView> views;
  for (int i = 0; i < 8; ++i) {
    views.push_back(LookAt({i - 4.0, -8, 0.5 * std::cos(i)}, {0, 0, 0}));
  }
  return views;
}

PosedView ViewFromAbove() { return LookAt({0, -6, 6}, {0, 0, 0}); }

// The samples move along rays from amid the cameras, so that the views along x
// hardly see it.
Curve WavyInDepth(Curve curve, double amplitude_px) {
  const Eigen::Vector3d center(-0.5, -8, 0);
  for (std::size_t k = 0; k < curve.samples.size(); ++k) {
    Eigen::Vector3d& position = curve.samples[k].position;
    const double wave = std::sin(0.1 * static_cast<double>(k));
    position += amplitude_px * kPixel * wave * (position - center).normalized();
  }
  SetTangentsAlongChords(curve);
  return curve;
}

Curve Flatten(const SeenCurve& seen,
              Curve curve,
              const CurveRefinementOptions& options = {}) {
  return FlattenCurves({std::move(curve)},
                       {seen.views, seen.edge_maps, kEdgeSigmaPx, options, 1},
                       {})
      .at(0);
}

TEST(FlattenCurves, ALineAlongTheBaselineBecomesStraight) {
  SeenCurve seen =
      SeeFrom(ViewsAlongX(), Line(InPlane(-80, 0), InPlane(80, 0)));
  Random random(3);
  for (EdgeMap& map : seen.edge_maps) {
    for (Edge2d& edge : map.edges) {
      edge.position.y() += 0.15 * random.NormalVector().x();
    }
  }
  const Curve flat = Flatten(seen, WavyInDepth(seen.truth, 10));
  for (const CurveSample& sample : flat.samples) {
    EXPECT_LT(std::abs(sample.tangent.y()), 0.05);
    EXPECT_LT(sample.position.tail<2>().norm(), 2 * kPixel);
  }
}

TEST(FlattenCurves, TheShapeInImagesStays) {
  const SeenCurve seen =
      SeeFrom(ViewsAlongX(),
              Arc(100, 0.35 * std::numbers::pi, 0.65 * std::numbers::pi));
  const Curve flat = Flatten(seen, WavyInDepth(seen.truth, 6));
  for (std::size_t k = 0; k < flat.samples.size(); ++k) {
    const Eigen::Vector3d offset =
        flat.samples[k].position - seen.truth.samples[k].position;
    EXPECT_LT(std::abs(offset.y()), kPixel) << k;
    EXPECT_LT(std::abs(offset.z()), 0.2 * kPixel) << k;
  }
}

// Least squares alone would let eight views outvote it.
TEST(FlattenCurves, OneViewFromElsewhereKeepsACurveThatIsNotPlanar) {
  std::vector<PosedView> views = ViewsAlongX();
  const Curve wavy = WavyInDepth(Line(InPlane(-80, 0), InPlane(80, 0)), 3);
  const SeenCurve along_x = SeeFrom(views, wavy);
  EXPECT_GT(LargestDistance({Flatten(along_x, along_x.truth)}, {along_x.truth}),
            kPixel);
  views.push_back(ViewFromAbove());
  const SeenCurve seen = SeeFrom(views, wavy);
  EXPECT_EQ(LargestDistance({Flatten(seen, seen.truth)}, {seen.truth}), 0);
}

TEST(FlattenCurves, WhatImagesDetermineStays) {
  std::vector<PosedView> views;
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.25 * std::numbers::pi * i;
    views.push_back(
        LookAt({6 * std::cos(angle), 6 * std::sin(angle), 3}, {0, 0, 0}));
  }
  // Its bends are below the limit of distances in images.
  Curve bent = Line(InPlane(-40, 0), InPlane(40, 0));
  for (CurveSample& sample : bent.samples) {
    const double x = sample.position.x() / kPixel / 40;
    sample.position.z() += 0.5 * kPixel * x * x * x;
  }
  const SeenCurve seen = SeeFrom(views, bent);
  EXPECT_EQ(LargestDistance({Flatten(seen, seen.truth)}, {seen.truth}), 0);
}

TEST(FlattenCurves, PlanarCurvesStay) {
  const SeenCurve seen =
      SeeFrom(EightViews(), Arc(100, 0, 2 * std::numbers::pi));
  EXPECT_LT(LargestDistance({Flatten(seen, seen.truth)}, {seen.truth}),
            1e-2 * kPixel);
}

TEST(FlattenCurves, WithoutSmoothingOrSupportNothingMoves) {
  const SeenCurve seen =
      SeeFrom(ViewsAlongX(), Line(InPlane(-80, 0), InPlane(80, 0)));
  Curve wavy = WavyInDepth(seen.truth, 10);
  CurveRefinementOptions options;
  options.smoothing_px = 0;
  EXPECT_EQ(LargestDistance({Flatten(seen, wavy, options)}, {wavy}), 0);
  for (CurveSample& sample : wavy.samples) sample.support.clear();
  EXPECT_EQ(LargestDistance({Flatten(seen, wavy)}, {wavy}), 0);
}

TEST(FlattenCurves, ResultsDoNotDependOnTheScale) {
  const double factor = 1000;
  const SeenCurve seen =
      SeeFrom(ViewsAlongX(), Line(InPlane(-80, 0), InPlane(80, 0)));
  const Curve wavy = WavyInDepth(seen.truth, 10);
  SeenCurve large = seen;
  large.views = Scaled(seen.views, factor);
  const Curve flat = Flatten(large, Scaled({wavy}, factor)[0]);
  EXPECT_LT(LargestDistance({flat}, Scaled({Flatten(seen, wavy)}, factor)),
            1e-6 * factor);
}

}  // namespace
}  // namespace curvix
