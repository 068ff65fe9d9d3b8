// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/refine_curves.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/median.h"
#include "curve_refinement/curve_ends.h"
#include "tests/curve_refinement/seen_curves.h"
#include "tests/support/random.h"

namespace curvix {
namespace {

constexpr CurveRefinementOptions kFitOptions = {.smoothing_px = 2.5};

// Views from directions `step` radian apart, on a wavy half circle.
std::vector<PosedView> ViewsAround(int num_views, double step) {
  std::vector<PosedView> views;
  for (int i = 0; i < num_views; ++i) {
    const double angle = step * i;
    const Eigen::Vector3d center(0, -std::cos(angle), std::sin(angle));
    views.push_back(
        LookAt(8 * center + Eigen::Vector3d(2 * std::cos(2 * angle), 0, 0),
               {0, 0, 0}));
  }
  return views;
}

SeenCurves See(std::vector<Curve> curves, std::vector<PosedView> views) {
  SeenCurves seen;
  seen.edge_maps = SupportByEdges(views, curves);
  seen.curves = std::move(curves);
  seen.views = std::move(views);
  return seen;
}

// Edges are off by what they share with their neighbours on the curve, and by
// what they do not.
void Disturb(double shared_px,
             double own_px,
             Random& random,
             SeenCurves& seen) {
  for (const Curve& curve : seen.curves) {
    std::vector<double> shared;
    for (std::size_t v = 0; v < seen.views.size(); ++v) {
      shared.push_back(shared_px * random.Normal());
    }
    for (const CurveSample& sample : curve.samples) {
      for (const EdgeRef& ref : sample.support) {
        const auto v = static_cast<std::size_t>(ref.view_idx);
        const auto e = static_cast<std::size_t>(ref.edge_idx);
        MoveAcross(shared[v] + own_px * random.Normal(),
                   seen.edge_maps[v].edges[e]);
      }
    }
  }
}

std::vector<Curve> WithCovariances(const SeenCurves& seen) {
  return EstimateCovariances(
      seen.curves,
      {seen.views, seen.edge_maps, kEdgeSigmaPx, kFitOptions, 1},
      {});
}

SeenCurves DisturbedLines(int num_lines,
                          const std::vector<PosedView>& views,
                          double shared_px,
                          double own_px) {
  const std::vector<Curve> lines(static_cast<std::size_t>(num_lines),
                                 Line(InPlane(-20, 0), InPlane(20, 0)));
  SeenCurves seen = See(lines, views);
  Random random(5);
  Disturb(shared_px, own_px, random, seen);
  return seen;
}

// Of distances from the line y = z = 0 in standard deviations of each axis,
// robustly: 1 if the covariances are right.
double NormalisedSpread(const std::vector<Curve>& lines) {
  std::vector<double> distances;
  for (const Curve& line : lines) {
    for (const CurveSample& sample : line.samples) {
      const Eigen::Vector2d error = sample.position.tail<2>();
      const Eigen::Matrix2d covariance =
          sample.covariance.bottomRightCorner<2, 2>();
      distances.push_back(std::sqrt(error.dot(covariance.inverse() * error)));
    }
  }
  const double median_of_two_axes = std::sqrt(2 * std::numbers::ln2);
  return Median(std::move(distances)) / median_of_two_axes;
}

TEST(EstimateCovariances, ErrorsAreAsLargeAsTheySay) {
  for (const auto& [num_views, step] :
       {std::pair{12, 0.25}, std::pair{6, 0.5}, std::pair{4, 0.5}}) {
    for (const auto& [shared_px, own_px] :
         {std::pair{0.05, 0.05}, std::pair{0.08, 0.0}}) {
      SeenCurves seen =
          DisturbedLines(60, ViewsAround(num_views, step), shared_px, own_px);
      seen.curves = FitToImages(
          std::move(seen.curves),
          {seen.views, seen.edge_maps, kEdgeSigmaPx, kFitOptions, 1},
          {});
      EXPECT_NEAR(NormalisedSpread(WithCovariances(seen)), 1, 0.3)
          << num_views << " views, " << shared_px << " and " << own_px << " px";
    }
  }
}

double MeanSigma(const std::vector<Curve>& curves) {
  double sum = 0, count = 0;
  for (const Curve& curve : curves) {
    for (const CurveSample& sample : curve.samples) {
      sum += sample.sigma;
      ++count;
    }
  }
  return sum / count;
}

TEST(EstimateCovariances, TheSameViewAgainTellsNothingNew) {
  const SeenCurves once = DisturbedLines(20, ViewsAround(12, 0.25), 0.1, 0);
  SeenCurves twice = once;
  for (std::size_t v = 0; v < once.views.size(); ++v) {
    twice.views.push_back(once.views[v]);
    twice.edge_maps.push_back(once.edge_maps[v]);
  }
  for (Curve& curve : twice.curves) {
    for (CurveSample& sample : curve.samples) {
      for (const EdgeRef& ref : std::vector(sample.support)) {
        sample.support.push_back({ref.view_idx + 12, ref.edge_idx});
      }
    }
  }
  EXPECT_NEAR(
      MeanSigma(WithCovariances(twice)) / MeanSigma(WithCovariances(once)),
      1,
      0.1);
}

TEST(EstimateCovariances, ViewsFarApartTellMore) {
  const SeenCurves few = DisturbedLines(20, ViewsAround(6, 0.5), 0.1, 0);
  const SeenCurves many = DisturbedLines(20, ViewsAround(24, 0.125), 0.1, 0);
  EXPECT_LT(MeanSigma(WithCovariances(many)),
            0.75 * MeanSigma(WithCovariances(few)));
}

TEST(EstimateCovariances, DepthIsLessSureThanTheImagePlane) {
  const SeenCurves seen = DisturbedLines(1, ViewsAround(5, 0.05), 0.05, 0);
  const CurveSample sample = WithCovariances(seen)[0].samples[20];
  const Eigen::Vector3d depth(0, std::cos(0.1), -std::sin(0.1));
  const Eigen::Vector3d sideways = Eigen::Vector3d::UnitX().cross(depth);
  EXPECT_GT(depth.dot(sample.covariance * depth),
            50 * sideways.dot(sample.covariance * sideways));
  EXPECT_NEAR(sample.covariance.trace(),
              2 * sample.sigma * sample.sigma,
              1e-9 * sample.covariance.trace());
  EXPECT_LT((sample.covariance * sample.tangent).norm(),
            1e-9 * sample.covariance.trace());
}

TEST(EstimateCovariances, OneViewTellsNothing) {
  for (const std::vector<PosedView>& views :
       {FrontalViews(), {ViewsAround(8, 0.25)[7]}}) {
    const SeenCurves seen = DisturbedLines(1, views, 0.05, 0);
    const Curve line = WithCovariances(seen)[0];
    for (std::size_t k = 0; k < line.samples.size(); ++k) {
      EXPECT_EQ(line.samples[k].sigma, seen.curves[0].samples[k].sigma);
      EXPECT_EQ(line.samples[k].covariance, Eigen::Matrix3d::Zero());
    }
  }
}

TEST(EstimateCovariances, DoesNotDependOnTheUnit) {
  const double factor = 1000;
  SeenCurves seen = DisturbedLines(2, ViewsAround(8, 0.25), 0.1, 0.05);
  const double sigma = MeanSigma(WithCovariances(seen));
  seen.curves = Scaled(std::move(seen.curves), factor);
  seen.views = Scaled(std::move(seen.views), factor);
  EXPECT_NEAR(MeanSigma(WithCovariances(seen)) / (factor * sigma), 1, 1e-9);
}

TEST(EstimateCovariances, ThreadsChangeNothing) {
  const SeenCurves seen = DisturbedLines(7, ViewsAround(8, 0.25), 0.1, 0.05);
  const std::vector<Curve> one = WithCovariances(seen);
  const std::vector<Curve> three = EstimateCovariances(
      seen.curves,
      {seen.views, seen.edge_maps, kEdgeSigmaPx, kFitOptions, 3},
      {});
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t k = 0; k < one[i].samples.size(); ++k) {
      EXPECT_EQ(one[i].samples[k].covariance, three[i].samples[k].covariance);
    }
  }
}

// A curve carried on by so many pixels, along what fits its last samples.
Curve CarriedOn(Curve curve,
                int length_px,
                const std::vector<PosedView>& views) {
  const EndFit fit = FitEnd(curve, true, {0, 17.5}, views);
  CurveSample added = curve.samples.back();
  added.support.clear();
  for (int k = 1; k <= length_px; ++k) {
    added.position = fit.PointAt(k * fit.pixel);
    curve.samples.push_back(added);
  }
  return curve;
}

TEST(EstimateCovariances, EndsThatAreCarriedOnAreLessCertain) {
  for (const auto& [shared_px, own_px] :
       {std::pair{0.05, 0.05}, std::pair{0.02, 0.1}}) {
    for (const int length_px : {3, 6, 9}) {
      SeenCurves seen =
          DisturbedLines(60, ViewsAround(12, 0.25), shared_px, own_px);
      seen.curves = FitToImages(
          std::move(seen.curves),
          {seen.views, seen.edge_maps, kEdgeSigmaPx, kFitOptions, 1},
          {});
      for (Curve& line : seen.curves) {
        line = CarriedOn(std::move(line), length_px, seen.views);
      }
      std::vector<Curve> ends;
      for (const Curve& line : WithCovariances(seen)) {
        ends.emplace_back().samples = {line.samples.back()};
      }
      EXPECT_NEAR(NormalisedSpread(ends), 1, 0.3)
          << shared_px << " " << own_px << " " << length_px;
    }
  }
}

}  // namespace
}  // namespace curvix
