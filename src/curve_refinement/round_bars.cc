// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves that are a side of a round bar.
#include "curve_refinement/occluding_contours.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/infinity.h"
#include "base/parallel.h"
#include "geometry/adjust_edge.h"
#include "geometry/directions.h"
#include "geometry/edge_geometry.h"
#include "geometry/pixel_size.h"
#include "model/sample_ranges.h"

namespace curvix {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Places of a curve, at most.
constexpr std::size_t kMaxPlaces = 12;
constexpr double kMinBarRadiusPx = 1;
constexpr double kMaxBarRadiusPx = 16;
// The far contour is twice the radius away.
constexpr double kBarReachPx = 2 * kMaxBarRadiusPx + 4;
constexpr double kStartRadiiPx[] = {1.5, 2, 2.7, 3.7, 5, 6.7, 9, 12.3};
// Views that see the bar from about the same side as most do: the cosine of the
// angle.
constexpr double kMinCosine = 0.3;
constexpr int kMinViews = 5;
constexpr int kNumBarIterations = 8;
// Of edges in the fits: the largest distance, and the scale of their weights.
constexpr double kGatePx = 1.5;
constexpr double kRobustSigmaPx = 0.4;
// Of the radius in one iteration.
constexpr double kMaxStepPx = 2;
// Keeps the systems regular; in measurements.
constexpr double kBarPrior = 1e-3;
// A curve is a side of the bar if it is so near to it, mean over places.
constexpr double kMaxDistancePx = 2;
// Mean log-likelihood ratio of a place, and the share of views that show both
// contours within so many standard deviations.
constexpr double kMinLogLikelihoodRatio = 3;
constexpr double kMinShareOfBoth = 0.15;
constexpr double kSeenSigmas = 3;

// What a view sees about a place of a curve.
struct BarPlaceInView {
  std::vector<double> edges_px;  // signed distances from the projected curve
  // How far a step across the curve moves its projection; pixels per pixel of
  // the curve, on AxesAcross().
  Vector2d slope = Vector2d::Zero();
  // The same for a step from the axis of a bar to the contour that is seen.
  double slope_of_radius = 0;
};

struct BarPlace {
  std::vector<BarPlaceInView> views;
  Vector2d outward = Vector2d::Zero();  // unit: the side of the first contour
  double density = 0;  // of other contours, per pixel across the curve
};

// `pixel`: of the curve, world units. `outward` is across the curve, unit.
BarPlace Look(const CurveSample& sample,
              const Vector3d& outward,
              double pixel,
              const ImageSupport& images) {
  const std::vector<PosedView>& views = images.views();
  const OccludingContour contour = {
      {sample.position, sample.tangent}, 0, outward};
  const AcrossAxes across = AxesAcross(sample.tangent);
  BarPlace place;
  place.outward = across.transpose() * outward;
  double num_edges = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const auto projected = ProjectInto(views[v], contour.axis);
    if (!projected) continue;
    const Vector3d side = SideSeenFrom(contour, views[v].center);
    if (side.dot(outward) < kMinCosine) continue;
    std::vector<double> edges_px = images.Beside(v, *projected, kBarReachPx);
    if (std::ranges::none_of(edges_px, [](double edge_px) {
          return std::abs(edge_px) < kMaxBarRadiusPx;
        })) {
      continue;
    }
    num_edges += static_cast<double>(edges_px.size());
    const Vector3d gradient =
        pixel *
        DistanceFrom(MeasurePlane(views[v], *projected), sample.position)
            .gradient;
    place.views.push_back({std::move(edges_px),
                           across.transpose() * gradient,
                           gradient.dot(side)});
  }
  place.density = DensityOfContours(
      num_edges, static_cast<double>(place.views.size()), kBarReachPx);
  return place;
}

// Places along the curve, whose outward sides follow each other. None if too
// few views see it.
std::vector<BarPlace> LookAlong(const Curve& curve,
                                const ImageSupport& images) {
  std::vector<BarPlace> places;
  const double pixel = PixelSize(curve, images.views());
  if (!(pixel > 0)) return places;
  Vector3d outward = Vector3d::Zero();
  for (const std::size_t i :
       SamplesAlong(curve, kPlaceSpacingPx * pixel, kMaxPlaces)) {
    const CurveSample& sample = curve.samples[i];
    if (sample.support.empty()) continue;
    const Vector3d side = MeanSide(sample, images.views());
    outward = side.dot(outward) < 0 ? Vector3d(-side) : side;
    BarPlace place = Look(sample, outward, pixel, images);
    if (place.views.size() >= kMinViews) places.push_back(std::move(place));
  }
  return places;
}

struct Bar {
  double radius_px = 0;
  std::vector<Vector2d> axis;  // by place, from the curve, on AxesAcross()
};

// Least squares over the edges near both contours: one radius, and an axis at
// each place.
void Adjust(const std::vector<BarPlace>& places, Bar* bar) {
  struct OfPlace {
    Matrix2d inverse;
    Vector2d of_radius, of_residuals;
  };
  std::vector<OfPlace> eliminated;
  double information = kBarPrior, gradient = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Matrix2d matrix = kBarPrior * Matrix2d::Identity();
    Vector2d of_radius = Vector2d::Zero(), of_residuals = Vector2d::Zero();
    for (const BarPlaceInView& seen : places[i].views) {
      for (const double side : {1.0, -1.0}) {
        const double slope_of_radius = side * seen.slope_of_radius;
        const double residual = NearestResidual(
            seen.edges_px,
            seen.slope.dot(bar->axis[i]) + slope_of_radius * bar->radius_px);
        if (!(std::abs(residual) <= kGatePx)) continue;
        const double weight = CauchyWeight(residual, kRobustSigmaPx);
        matrix += weight * seen.slope * seen.slope.transpose();
        of_radius += weight * slope_of_radius * seen.slope;
        of_residuals += weight * residual * seen.slope;
        information += weight * slope_of_radius * slope_of_radius;
        gradient += weight * slope_of_radius * residual;
      }
    }
    const Matrix2d inverse = matrix.inverse();
    information -= of_radius.dot(inverse * of_radius);
    gradient -= of_radius.dot(inverse * of_residuals);
    eliminated.push_back({inverse, of_radius, of_residuals});
  }
  const double step =
      std::clamp(gradient / information, -kMaxStepPx, kMaxStepPx);
  bar->radius_px += step;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const OfPlace& of_place = eliminated[i];
    bar->axis[i] +=
        of_place.inverse * (of_place.of_residuals - step * of_place.of_radius);
  }
}

// The edge in space that fits best, from `start`, a step from the curve.
Vector2d FitEdge(const BarPlace& place, const Vector2d& start) {
  Vector2d at = start;
  for (int iteration = 0; iteration < kNumBarIterations; ++iteration) {
    Matrix2d matrix = kBarPrior * Matrix2d::Identity();
    Vector2d gradient = Vector2d::Zero();
    for (const BarPlaceInView& seen : place.views) {
      const double residual =
          NearestResidual(seen.edges_px, seen.slope.dot(at));
      if (!(std::abs(residual) <= kGatePx)) continue;
      const double weight = CauchyWeight(residual, kRobustSigmaPx);
      matrix += weight * seen.slope * seen.slope.transpose();
      gradient += weight * residual * seen.slope;
    }
    at += matrix.inverse() * gradient;
  }
  return at;
}

// From where a view shows the contours of a bar to the nearest edges.
std::array<double, 2> ResidualsOfSides(const BarPlaceInView& seen,
                                       const Vector2d& axis,
                                       double radius_px) {
  const double middle_px = seen.slope.dot(axis);
  const double half_px = seen.slope_of_radius * radius_px;
  return {NearestResidual(seen.edges_px, middle_px + half_px),
          NearestResidual(seen.edges_px, middle_px - half_px)};
}

// Whether enough views show both contours.
bool ShowsBoth(const std::vector<BarPlace>& places,
               const Bar& bar,
               double edge_sigma_px) {
  double num_views = 0, num_both = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const BarPlaceInView& seen : places[i].views) {
      const auto [side1, side2] =
          ResidualsOfSides(seen, bar.axis[i], bar.radius_px);
      num_both += std::max(std::abs(side1), std::abs(side2)) <
                  kSeenSigmas * edge_sigma_px;
      ++num_views;
    }
  }
  return num_both >= kMinShareOfBoth * num_views;
}

// Log-likelihood ratio of a bar, whose contour on `side` is the curve, to edges
// in space, mean over places: one edge by each contour, and the curve itself.
double RatioOfBar(const std::vector<BarPlace>& places,
                  const Bar& bar,
                  double side,
                  double edge_sigma_px) {
  double ratio = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const BarPlace& place = places[i];
    const Vector2d to_side = bar.radius_px * place.outward;
    const Vector2d edge1 = FitEdge(place, bar.axis[i] + to_side);
    const Vector2d edge2 = FitEdge(place, bar.axis[i] - to_side);
    for (const BarPlaceInView& seen : place.views) {
      const auto residual = [&](double at_px) {
        return NearestResidual(seen.edges_px, at_px);
      };
      const auto log_likelihood = [&](double residual_px) {
        return LogLikelihoodOfContour(
            residual_px, edge_sigma_px, place.density);
      };
      const auto [side1, side2] =
          ResidualsOfSides(seen, bar.axis[i], bar.radius_px);
      double of_edge1 = log_likelihood(residual(seen.slope.dot(edge1)));
      double of_edge2 = log_likelihood(residual(seen.slope.dot(edge2)));
      double& of_own_edge = side > 0 ? of_edge1 : of_edge2;
      of_own_edge = std::max(of_own_edge, log_likelihood(residual(0)));
      ratio +=
          log_likelihood(side1) + log_likelihood(side2) - of_edge1 - of_edge2;
    }
  }
  return ratio / static_cast<double>(places.size());
}

// The same of the bar near `start_radius_px`, whose contour on `side` is the
// curve; minus infinity without one.
double RatioNear(const std::vector<BarPlace>& places,
                 double start_radius_px,
                 double side,
                 double edge_sigma_px) {
  Bar bar{start_radius_px, {}};
  for (const BarPlace& place : places) {
    bar.axis.push_back(-side * start_radius_px * place.outward);
  }
  for (int iteration = 0; iteration < kNumBarIterations; ++iteration) {
    Adjust(places, &bar);
  }
  if (bar.radius_px < kMinBarRadiusPx || bar.radius_px > kMaxBarRadiusPx) {
    return -kInfinity;
  }
  double distance_px = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    distance_px +=
        (bar.axis[i] + side * bar.radius_px * places[i].outward).norm();
  }
  if (distance_px > kMaxDistancePx * static_cast<double>(places.size()) ||
      !ShowsBoth(places, bar, edge_sigma_px)) {
    return -kInfinity;
  }
  return RatioOfBar(places, bar, side, edge_sigma_px);
}

// The same of the likeliest bar; minus infinity without any.
double BestRatio(const std::vector<BarPlace>& places, double edge_sigma_px) {
  double best = -kInfinity;
  if (places.empty()) return best;
  for (const double radius_px : kStartRadiiPx) {
    for (const double side : {1.0, -1.0}) {
      best = std::max(best, RatioNear(places, radius_px, side, edge_sigma_px));
    }
  }
  return best;
}

}  // namespace

void LabelRoundBars(const std::vector<PosedView>& views,
                    const std::vector<EdgeMap>& edge_maps,
                    double edge_sigma_px,
                    int num_threads,
                    std::vector<Curve>* curves) {
  const ImageSupport images(views, edge_maps, num_threads);
  ParallelFor(curves->size(), num_threads, [&](std::size_t i) {
    Curve& curve = (*curves)[i];
    if (MainKind(curve) == CurveKind::kOccludingContour) return;
    const double ratio = BestRatio(LookAlong(curve, images), edge_sigma_px);
    if (ratio < kMinLogLikelihoodRatio) return;
    for (CurveSample& sample : curve.samples) {
      sample.kind = CurveKind::kOccludingContour;
      sample.kind_probability = static_cast<float>(1 / (1 + std::exp(-ratio)));
    }
  });
}

}  // namespace curvix
