// SPDX-License-Identifier: BSD-3-Clause
#include "poses/held_out.h"

#include <curvix/scene.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/median.h"
#include "base/parallel.h"
#include "geometry/fit_point.h"

namespace curvix {
namespace {

constexpr double kMaxErrorPx = 1;  // of places
constexpr double kMaxPointErrorPx = 2;
constexpr double kMinTruncationPx = 0.3;
constexpr double kNothingFitsPx = 1;
constexpr double kHarmlessShiftPx = 0.5;
constexpr double kMaxShiftPerFall = 4;
// Standard deviations, exceeded by chance once in some twenty times.
constexpr double kContrary = 2;

// The errors of a place fitted to the poses of `edges`, by query view.
std::map<std::size_t, double> ErrorsOfPlace(const CurvePlace& start,
                                            const PosedEdges& edges) {
  const std::vector<std::size_t> views = edges.QueryViews(start);
  CurvePlace place = start;
  struct Pass {
    double gate_px, sigma_px;
  };
  for (const Pass& pass : {Pass{2, 0.5}, Pass{1, 0.25}, Pass{1, 0.15}}) {
    const std::vector<double> gates(edges.views().size(), pass.gate_px);
    place.support = edges.FindEdges(place.contour, views, gates);
    place.contour = edges.Adjusted(place, pass.sigma_px);
  }
  const std::vector<double> gates(edges.views().size(), kMaxErrorPx);
  std::map<std::size_t, double> errors;
  for (const EdgeRef& ref : edges.FindEdges(place.contour, views, gates)) {
    errors[static_cast<std::size_t>(ref.view_idx)] =
        std::min(kMaxErrorPx, edges.Distance(place.contour, ref));
  }
  return errors;
}

std::vector<double> ErrorsOfPoint(const PointSample& point,
                                  const PosedEdges& edges) {
  const std::vector<PointInImage> seen = edges.Observed(point);
  const Eigen::Vector3d position = FitPoint(point.position, seen);
  std::vector<double> errors;
  for (const PointInImage& at : seen) {
    const auto pixel = Project(*at.camera, at.cam_from_world, position);
    errors.push_back(
        pixel ? std::min(kMaxPointErrorPx, (*pixel - at.pixel).norm())
              : kMaxPointErrorPx);
  }
  return errors;
}

// Errors over three times the smaller of their medians, or over 0.3 px; at most
// 1, so that outliers and differences of perfect fits count little.
class TruncatedLoss {
 public:
  TruncatedLoss(std::vector<double> before, std::vector<double> after)
      : scale_px_(std::max(kMinTruncationPx,
                           3 * std::min(MedianOr(1, std::move(before)),
                                        MedianOr(1, std::move(after))))) {}
  double operator()(double error_px) const {
    return std::min(1.0, error_px / scale_px_);
  }

 private:
  double scale_px_;
};

double MeanSquare(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

// The largest e(t) = sum of (t x - log cosh(t x)), t >= 0, over `gains` x of
// mean square 1: if signs are random, their sum is reached with a probability
// of at most exp(-e(t)) for any t.
double LargestChernoffExponent(const std::vector<double>& gains) {
  // Slope of e(t), which falls with t.
  const auto slope = [&](double t) {
    double sum = 0;
    for (const double x : gains) sum += x * (1 - std::tanh(t * x));
    return sum;
  };
  double low = 0, high = 30;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (slope(middle) > 0 ? low : high) = middle;
  }
  // log cosh(y) = |y| + log(1 + exp(-2 |y|)) - log 2
  double exponent = 0;
  for (const double x : gains) {
    const double y = low * x;
    exponent += y - std::abs(y) - std::log1p(std::exp(-2 * std::abs(y))) +
                std::numbers::ln2;
  }
  return std::max(0.0, exponent);
}

}  // namespace

double FallOfErrors(const HeldOutErrors& before, const HeldOutErrors& after) {
  std::vector<double> places_before, places_after;
  for (const ErrorPair& pair : PairErrors(before, after)) {
    places_before.push_back(pair.before);
    places_after.push_back(pair.after);
  }
  const double fall =
      std::max(MeanSquare(places_before) - MeanSquare(places_after),
               MeanSquare(Concatenate(before.points)) -
                   MeanSquare(Concatenate(after.points)));
  return std::sqrt(std::max(0.0, fall));
}

bool IsShiftTooLarge(double shift_px, double fall_px) {
  return shift_px > std::max(kHarmlessShiftPx, kMaxShiftPerFall * fall_px);
}

bool PointsFit(const PoseObservationSet& held_out,
               const HeldOutErrors& errors,
               std::size_t num_views) {
  std::vector<std::vector<double>> by_view(num_views);
  for (std::size_t i = 0; i < held_out.points.size(); ++i) {
    const auto& seen = held_out.points[i].observations;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      by_view[static_cast<std::size_t>(seen[k].view_idx)].push_back(
          errors.points[i][k]);
    }
  }
  return PointsFit(std::move(by_view));
}

bool EdgesFit(const HeldOutErrors& errors) {
  std::vector<double> of_places;
  for (const auto& of_place : errors.places) {
    for (const auto& [view_idx, error] : of_place) of_places.push_back(error);
  }
  return MedianOr(kNothingFitsPx, std::move(of_places)) < kGoodPoseErrorPx;
}

double SignificanceOf(const std::vector<double>& gains) {
  double sum = 0, squares = 0;
  for (const double gain : gains) {
    sum += gain;
    squares += gain * gain;
  }
  if (sum == 0) return 0;
  const double sign = sum > 0 ? 1 : -1;
  const double scale =
      sign * std::sqrt(static_cast<double>(gains.size()) / squares);
  std::vector<double> scaled;
  for (const double gain : gains) scaled.push_back(scale * gain);
  return sign * std::sqrt(2 * LargestChernoffExponent(scaled));
}

std::vector<double> GainsByCell::Normalized() const {
  double squares = 0;
  for (const auto& [cell, gain] : gains_) squares += gain * gain;
  std::vector<double> normalized;
  if (squares == 0) return normalized;
  for (const auto& [cell, gain] : gains_) {
    normalized.push_back(gain / std::sqrt(squares));
  }
  return normalized;
}

HeldOutErrors MeasureHeldOut(const PoseObservationSet& held_out,
                             const PosedEdges& edges) {
  HeldOutErrors errors;
  errors.places.resize(held_out.places.size());
  errors.points.resize(held_out.points.size());
  ParallelFor(errors.places.size(), edges.num_threads(), [&](std::size_t i) {
    errors.places[i] = ErrorsOfPlace(held_out.places[i], edges);
  });
  ParallelFor(errors.points.size(), edges.num_threads(), [&](std::size_t i) {
    errors.points[i] = ErrorsOfPoint(held_out.points[i], edges);
  });
  return errors;
}

std::vector<ErrorPair> PairErrors(const HeldOutErrors& before,
                                  const HeldOutErrors& after) {
  std::vector<ErrorPair> pairs;
  for (std::size_t i = 0; i < before.places.size(); ++i) {
    std::map<std::size_t, ErrorPair> by_view;
    for (const auto& [view_idx, error] : before.places[i]) {
      by_view[view_idx] = {i, view_idx, error, kMaxErrorPx};
    }
    for (const auto& [view_idx, error] : after.places[i]) {
      const ErrorPair new_pair = {i, view_idx, kMaxErrorPx, kMaxErrorPx};
      by_view.try_emplace(view_idx, new_pair).first->second.after = error;
    }
    for (const auto& [view_idx, pair] : by_view) pairs.push_back(pair);
  }
  return pairs;
}

HeldOutGains CompareErrors(const PoseObservationSet& held_out,
                           const SpaceCells& cells,
                           const HeldOutErrors& before,
                           const HeldOutErrors& after) {
  const std::vector<ErrorPair> pairs = PairErrors(before, after);
  std::vector<double> from, to;
  for (const ErrorPair& pair : pairs) {
    from.push_back(pair.before);
    to.push_back(pair.after);
  }
  const TruncatedLoss loss_of_places(from, to);
  GainsByCell places(cells);
  for (const ErrorPair& pair : pairs) {
    places.Add(PositionOf(held_out.places[pair.place_idx]),
               loss_of_places(pair.before) - loss_of_places(pair.after));
  }
  const TruncatedLoss loss_of_points(Concatenate(before.points),
                                     Concatenate(after.points));
  GainsByCell points(cells);
  for (std::size_t i = 0; i < held_out.points.size(); ++i) {
    for (std::size_t k = 0; k < before.points[i].size(); ++k) {
      points.Add(held_out.points[i].position,
                 loss_of_points(before.points[i][k]) -
                     loss_of_points(after.points[i][k]));
    }
  }
  return {std::move(places), std::move(points)};
}

HeldOutGains CompareLosses(const PoseObservationSet& held_out,
                           const SpaceCells& cells,
                           const std::vector<double>& before,
                           const std::vector<double>& after) {
  const std::vector<Eigen::Vector3d> positions = PositionsOf(held_out);
  HeldOutGains gains = {GainsByCell(cells), GainsByCell(cells)};
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double gain = before[i] - after[i];
    if (!std::isfinite(gain)) continue;
    (i < held_out.places.size() ? gains.places : gains.points)
        .Add(positions[i], gain);
  }
  return gains;
}

SignificanceOfGain Together(const HeldOutGains& gains) {
  const std::vector<double> places = gains.places.Normalized();
  const std::vector<double> points = gains.points.Normalized();
  return {SignificanceOf(places),
          SignificanceOf(points),
          SignificanceOf(Concatenate<double>({places, points}))};
}

bool IsBetter(const SignificanceOfGain& gain, double least) {
  return gain.all >= least && IsNoWorse(gain);
}

bool IsNoWorse(const SignificanceOfGain& gain) {
  return gain.all >= 0 && std::min(gain.places, gain.points) >= -kContrary;
}

bool MayBecomeBetter(const SignificanceOfGain& gain, int num_sets) {
  const double share = static_cast<double>(num_sets) / SpaceCells::kNumSets;
  return IsNoWorse(gain) && gain.all >= kSignificant * std::sqrt(share);
}

std::vector<bool> WorseViews(const std::vector<ErrorPair>& pairs,
                             std::size_t num_views) {
  std::vector<double> sums(num_views, 0), squares(num_views, 0);
  for (const ErrorPair& pair : pairs) {
    const double gain = pair.before - pair.after;
    sums[pair.view_idx] += gain;
    squares[pair.view_idx] += gain * gain;
  }
  std::vector<bool> worse(num_views);
  for (std::size_t i = 0; i < num_views; ++i) {
    worse[i] = sums[i] < -kContrary * std::sqrt(squares[i]);
  }
  return worse;
}

}  // namespace curvix
