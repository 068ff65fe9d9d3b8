// SPDX-License-Identifier: BSD-3-Clause
#include "curve_refinement/occluding_contours.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/infinity.h"
#include "geometry/adjust_edge.h"
#include "geometry/directions.h"
#include "geometry/edge_geometry.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kReachPx = 8;
constexpr double kMinRadiusPx = 3;
constexpr double kMaxRadiusPx = 400;
// Edges as near as this to the curve tell no radius.
constexpr double kOnCurvePx = 0.6;
// Nor do views that look from so nearly the same side ...
constexpr double kMinTurn = 0.002;
// ... or from so far round that they may see the other side of the body.
constexpr double kMaxTurn = 0.8;
// Akaike's penalty of another edge: its place across the curve.
constexpr double kNumParametersOfEdge = 2;
constexpr int kNumIterations = 4;
// Edges nearer than this to a contour refine it.
constexpr double kInlierPx = 1;
// Bodies are not exactly cylinders: share of the distance from the curve by
// which a contour may be off.
constexpr double kRelativeError = 0.05;

// What a view with edges there sees about a place of a curve.
struct PlaceInView {
  std::vector<double> edges_px;  // signed distances from the projected curve
  // How far the contour is seen from the curve, pixels, for a step of the axis
  // across itself and for a radius of 1, world units.
  Vector3d slope = Vector3d::Zero();
  double turn = 0;  // 1 - cos(angle from the middle of the supporting views)
};

struct Place {
  std::vector<PlaceInView> views;
  double pixel = 0;    // world units
  double density = 0;  // of other contours, per pixel across the curve
};

Place Look(const CurveSample& sample, const ImageSupport& images) {
  const std::vector<PosedView>& views = images.views();
  const SpaceEdge axis = {sample.position, sample.tangent};
  const OccludingContour contour = {axis, 0, MeanSide(sample, views)};
  const AcrossAxes across = AxesAcross(sample.tangent);
  Place place;
  place.pixel = PixelSize(sample, views);
  double num_edges = 0, num_views = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const auto projected = ProjectInto(views[v], axis);
    if (!projected) continue;
    ++num_views;
    std::vector<double> edges_px = images.Beside(v, *projected, kReachPx);
    if (edges_px.empty()) continue;
    num_edges += static_cast<double>(edges_px.size());
    PlaceInView& seen = place.views.emplace_back();
    seen.edges_px = std::move(edges_px);
    const Vector3d gradient =
        DistanceFrom(MeasurePlane(views[v], *projected), axis.position)
            .gradient;
    const Vector3d side = SideSeenFrom(contour, views[v].center);
    seen.slope << across.transpose() * gradient,
        gradient.dot(side - contour.outward);
    seen.turn = 1 - side.dot(contour.outward);
  }
  place.density = DensityOfContours(num_edges, num_views, kReachPx);
  return place;
}

// A step of the axis across itself, and a radius, world units.
using Contour = Vector3d;

double LogLikelihood(const Place& place,
                     const PlaceInView& seen,
                     const Contour& contour,
                     double edge_sigma_px) {
  const double offset_px = seen.slope.dot(contour);
  return LogLikelihoodOfContour(
      NearestResidual(seen.edges_px, offset_px),
      std::hypot(edge_sigma_px, kRelativeError * offset_px),
      place.density);
}

double LogLikelihood(const Place& place,
                     const Contour& contour,
                     double edge_sigma_px) {
  double sum = 0;
  for (const PlaceInView& seen : place.views) {
    sum += LogLikelihood(place, seen, contour, edge_sigma_px);
  }
  return sum;
}

// That the curve is an edge, with another edge beside it, at the step `other`.
double LogLikelihoodOfEdges(const Place& place,
                            const Contour& other,
                            double edge_sigma_px) {
  double sum = 0;
  for (const PlaceInView& seen : place.views) {
    sum += std::max(LogLikelihood(place, seen, Contour::Zero(), edge_sigma_px),
                    LogLikelihood(place, seen, other, edge_sigma_px));
  }
  return sum;
}

// The edge that explains best what the contour explains beside the curve.
Contour OtherEdge(const Place& place,
                  const Contour& contour,
                  double edge_sigma_px) {
  Contour other = Contour::Zero();
  for (int iteration = 0; iteration < kNumIterations; ++iteration) {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    for (const PlaceInView& seen : place.views) {
      const double offset_px = seen.slope.dot(contour);
      const double residual = NearestResidual(seen.edges_px, offset_px);
      if (std::abs(offset_px) < kOnCurvePx || std::abs(residual) > kInlierPx) {
        continue;
      }
      const double edge_px = offset_px + residual;
      const Eigen::Vector2d slope = seen.slope.head<2>();
      const double weight =
          iteration == 0
              ? 1
              : CauchyWeight(edge_px - seen.slope.dot(other), edge_sigma_px);
      information += weight * slope * slope.transpose();
      gradient += weight * slope * edge_px;
    }
    const Eigen::Vector2d step = information.ldlt().solve(gradient);
    if (!step.allFinite()) return Contour::Zero();
    other.head<2>() = step;
  }
  return other;
}

bool IsPossible(const Place& place, double radius) {
  return std::abs(radius) >= kMinRadiusPx * place.pixel &&
         std::abs(radius) <= kMaxRadiusPx * place.pixel;
}

// Least squares over the edges near the contour.
Contour Refine(const Place& place, const Contour& contour) {
  Matrix3d information = Matrix3d::Zero();
  Vector3d gradient = Vector3d::Zero();
  for (const PlaceInView& seen : place.views) {
    const double residual =
        NearestResidual(seen.edges_px, seen.slope.dot(contour));
    if (std::abs(residual) > kInlierPx) continue;
    information += seen.slope * seen.slope.transpose();
    gradient += seen.slope * residual;
  }
  const Vector3d step = information.ldlt().solve(gradient);
  return step.allFinite() ? Contour(contour + step) : contour;
}

double LogLikelihoodRatio(const Place& place, double edge_sigma_px) {
  double best = -kInfinity;
  Contour best_contour = Contour::Zero();
  for (const PlaceInView& seen : place.views) {
    if (seen.turn < kMinTurn || seen.turn > kMaxTurn) continue;
    for (double edge_px : seen.edges_px) {
      const Contour contour(0, 0, edge_px / seen.slope.z());
      if (std::abs(edge_px) < kOnCurvePx || !IsPossible(place, contour.z())) {
        continue;
      }
      const double log_likelihood =
          LogLikelihood(place, contour, edge_sigma_px);
      if (log_likelihood > best) {
        best = log_likelihood;
        best_contour = contour;
      }
    }
  }
  if (!std::isfinite(best)) return 0;
  const Contour refined = Refine(place, best_contour);
  if (IsPossible(place, refined.z())) {
    best = std::max(best, LogLikelihood(place, refined, edge_sigma_px));
  }
  const Contour other = OtherEdge(place, best_contour, edge_sigma_px);
  return best - std::max(LogLikelihood(place, Contour::Zero(), edge_sigma_px),
                         LogLikelihoodOfEdges(place, other, edge_sigma_px) -
                             kNumParametersOfEdge);
}

}  // namespace

double ContourLogLikelihoodRatio(const Curve& curve,
                                 const ImageSupport& images,
                                 double edge_sigma_px) {
  double sum = 0;
  double num_places = 0;
  double to_next = kPlaceSpacingPx / 2;
  std::size_t last_supported = 0;
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    if (!curve.samples[i].support.empty()) last_supported = i;
  }
  for (std::size_t i = 0; i < curve.samples.size(); ++i) {
    const CurveSample& sample = curve.samples[i];
    const double pixel = PixelSize(sample, images.views());
    if (!(pixel > 0)) continue;
    if (i > 0) {
      to_next -=
          (sample.position - curve.samples[i - 1].position).norm() / pixel;
    }
    if (sample.support.empty()) continue;
    const bool is_too_short = i == last_supported && num_places == 0;
    if (to_next > 0 && !is_too_short) continue;
    to_next = kPlaceSpacingPx;
    sum += LogLikelihoodRatio(Look(sample, images), edge_sigma_px);
    ++num_places;
  }
  return num_places > 0 ? sum / num_places : 0;
}

}  // namespace curvix
