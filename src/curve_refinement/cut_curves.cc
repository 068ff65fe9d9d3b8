// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Cuts of curves: where they touch others, and at
// corners that are too blunt to see before the fit.
#include "curve_refinement/refine_curves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/angles.h"
#include "base/parallel.h"
#include "curve_refinement/curve_ends.h"
#include "geometry/directions.h"
#include "geometry/pixel_size.h"
#include "model/curve_chains.h"
#include "model/sample_ranges.h"

namespace curvix {
namespace {

constexpr double kBesideTouchPx = 2;
constexpr double kTouchPx = 1;
constexpr double kMaxTouchAngleDeg = 10;
constexpr double kMaxLengthPx = 120;
constexpr double kMinBeyondPx = 5;

using Samples = std::set<std::size_t>;

// Samples of two curves, `a` the one with the smaller index.
struct NearPair {
  double distance_px = 0;
  SamplePlace a;
  SamplePlace b;
};

// What is beside what.
struct Neighbors {
  std::vector<NearPair> touches;  // nearest first
  // By curve and other curve: the samples of the former.
  std::map<std::pair<std::size_t, std::size_t>, Samples> beside;
};

Neighbors FindNeighbors(const std::vector<Curve>& curves,
                        const std::vector<PosedView>& views) {
  const SampleTree samples(curves);
  Neighbors neighbors;
  for (const SamplePlace& a : samples.Places()) {
    const CurveSample& sample = curves[a.curve_idx].samples[a.sample_idx];
    const double pixel = PixelSize(sample, views);
    if (!(pixel > 0)) continue;
    for (const std::size_t i :
         samples.Within(sample.position, kBesideTouchPx * pixel)) {
      const SamplePlace& b = samples.Places()[i];
      const CurveSample& other = curves[b.curve_idx].samples[b.sample_idx];
      if (a.curve_idx == b.curve_idx ||
          std::abs(sample.tangent.dot(other.tangent)) <
              std::cos(DegToRad(kMaxTouchAngleDeg))) {
        continue;
      }
      neighbors.beside[{a.curve_idx, b.curve_idx}].insert(a.sample_idx);
      neighbors.beside[{b.curve_idx, a.curve_idx}].insert(b.sample_idx);
      const double distance_px =
          (other.position - sample.position).norm() / pixel;
      if (a.curve_idx < b.curve_idx && distance_px <= kTouchPx) {
        neighbors.touches.push_back({distance_px, a, b});
      }
    }
  }
  std::ranges::stable_sort(neighbors.touches, {}, &NearPair::distance_px);
  return neighbors;
}

// The segment of a curve around a sample that is beside another curve.
struct TouchingSegment {
  Samples samples;  // with those beyond either end
  std::size_t middle = 0;
};

// Nullopt if it is too long, or the curve does not go on beyond it.
std::optional<TouchingSegment> SegmentAround(const Curve& curve,
                                             std::size_t sample_idx,
                                             const Samples& beside,
                                             double pixel) {
  const auto around = SamplesAround(
      curve, sample_idx, (kMaxLengthPx + 2 * kMinBeyondPx) * pixel);
  TouchingSegment segment;
  double reach[2] = {0, 0};  // ahead and behind
  bool goes_on[2] = {false, false};
  for (const SampleAround& place : around) {
    const int side = place.along < 0;
    const double away = std::abs(place.along);
    if (goes_on[side]) continue;
    segment.samples.insert(place.index);
    if (beside.contains(place.index)) {
      reach[side] = away;
    } else {
      goes_on[side] = away - reach[side] >= kMinBeyondPx * pixel;
    }
  }
  if (!goes_on[0] || !goes_on[1] ||
      reach[0] + reach[1] > kMaxLengthPx * pixel) {
    return std::nullopt;
  }
  const double middle = (reach[0] - reach[1]) / 2;
  segment.middle =
      std::ranges::min_element(around, {}, [&](const SampleAround& place) {
        return std::abs(place.along - middle);
      })->index;
  return segment;
}

bool Overlap(const Samples& a, const Samples& b) {
  return std::ranges::any_of(a, [&](std::size_t k) { return b.contains(k); });
}

}  // namespace

std::vector<Curve> CutAtTouches(std::vector<Curve> curves,
                                const RefinementInput& input) {
  const Neighbors neighbors = FindNeighbors(curves, input.views);
  std::vector<Samples> taken(curves.size());
  std::vector<Samples> cuts(curves.size());
  for (const NearPair& touch : neighbors.touches) {
    const std::size_t a = touch.a.curve_idx, b = touch.b.curve_idx;
    if (taken[a].contains(touch.a.sample_idx) ||
        taken[b].contains(touch.b.sample_idx)) {
      continue;
    }
    const CurveSample& nearest = curves[a].samples[touch.a.sample_idx];
    const double pixel = PixelSize(nearest, input.views);
    const auto of_a = SegmentAround(
        curves[a], touch.a.sample_idx, neighbors.beside.at({a, b}), pixel);
    const auto of_b = SegmentAround(
        curves[b], touch.b.sample_idx, neighbors.beside.at({b, a}), pixel);
    if (!of_a || !of_b || Overlap(of_a->samples, taken[a]) ||
        Overlap(of_b->samples, taken[b])) {
      continue;
    }
    Eigen::Vector3d& end_a = curves[a].samples[of_a->middle].position;
    Eigen::Vector3d& end_b = curves[b].samples[of_b->middle].position;
    if ((end_b - end_a).norm() > kBesideTouchPx * pixel) continue;
    end_a = end_b = (end_a + end_b) / 2;
    taken[a].insert(of_a->samples.begin(), of_a->samples.end());
    taken[b].insert(of_b->samples.begin(), of_b->samples.end());
    cuts[a].insert(of_a->middle);
    cuts[b].insert(of_b->middle);
  }
  std::vector<Curve> pieces;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    std::ranges::move(CutAt(curves[i], {cuts[i].begin(), cuts[i].end()}),
                      std::back_inserter(pieces));
  }
  return pieces;
}

namespace {

constexpr double kCornerBranchPx = 20;
constexpr double kMinCornerBranchPx = 8;
constexpr double kMaxCornerMissPx = 1;   // of the branches, of each other
constexpr double kCostOfMiss = 0.1;      // a pixel of rms is a pixel
constexpr double kMaxCornerRmsPx = 0.2;  // of the samples from their branches
constexpr double kMaxRmsShare = 0.3;     // of that from one parabola
// Blur takes so much off a corner, times the sine of half the angle by which it
// turns. At the crest of a wave the branches, carried on, meet further outside.
constexpr double kMaxRoundedOffPx = 2.2;
constexpr double kApartPx = 12;  // between two corners

// How a curve goes on at a sample where it is not straight.
struct Turn {
  bool is_corner = false;
  double misfit_px = 0;
  double pixel = 0;  // world units
};

// Between tangents half a branch before and behind a sample.
double TurnAround(const Curve& curve, std::size_t k, double pixel) {
  const auto around = SamplesAround(curve, k, kCornerBranchPx / 2 * pixel);
  const auto [first, last] =
      std::ranges::minmax_element(around, {}, &SampleAround::along);
  return AngleBetween(curve.samples[first->index].tangent,
                      curve.samples[last->index].tangent);
}

double MeanSquare(const Curve& branch, const EndFit& fit) {
  double sum = 0;
  for (const CurveSample& sample : branch.samples) {
    const double arc_length = fit.ArcLengthTo(sample.position);
    sum += (fit.PointAt(arc_length) - sample.position).squaredNorm();
  }
  return sum / static_cast<double>(branch.samples.size());
}

std::optional<Turn> TurnAt(const Curve& curve,
                           std::size_t k,
                           double max_turn,
                           const std::vector<PosedView>& views) {
  const CurveSample& sample = curve.samples[k];
  const double pixel = PixelSize(sample, views);
  // Straight on, as nearly everywhere.
  if (!(pixel > 0) || TurnAround(curve, k, pixel) < max_turn / 2) {
    return std::nullopt;
  }
  const BranchSegment segment{kRoundedPx * pixel, kCornerBranchPx * pixel};
  const Curve before = BranchTo(curve, k, true, segment);
  const Curve after = BranchTo(curve, k, false, segment);
  if (std::min(Length(before), Length(after)) < kMinCornerBranchPx * pixel)
    return std::nullopt;
  const EndFit in = FitEnd(before, true, {0, kCornerBranchPx}, views);
  const EndFit out = FitEnd(after, true, {0, kCornerBranchPx}, views);
  if (!(in.length > 0) || !(out.length > 0)) return std::nullopt;
  const double rms =
      std::sqrt((MeanSquare(before, in) + MeanSquare(after, out)) / 2);
  if (rms > kMaxCornerRmsPx * pixel ||
      rms > kMaxRmsShare * DistanceFromParabola(before, after)) {
    return std::nullopt;
  }
  const double arrival = in.ArcLengthTo(sample.position);
  const double departure = out.ArcLengthTo(sample.position);
  const double miss = (in.PointAt(arrival) - out.PointAt(departure)).norm();
  const double angle =
      AngleBetween(in.DirectionAt(arrival), -out.DirectionAt(departure));
  const double bend =
      std::max(in.length * in.bend.norm(), out.length * out.bend.norm());
  const double off =
      std::max((in.PointAt(arrival) - sample.position).norm(),
               (out.PointAt(departure) - sample.position).norm());
  const bool is_rounded =
      off <= kMaxRoundedOffPx * pixel * std::sin(angle / 2) + rms;
  return Turn{is_rounded && miss <= kMaxCornerMissPx * pixel &&
                  angle > std::max(max_turn, bend),
              std::hypot(rms, kCostOfMiss * miss) / pixel,
              pixel};
}

// Of neighbouring samples the one whose branches fit best, if it is a corner.
std::vector<std::size_t> CornersOf(const Curve& curve,
                                   const RefinementInput& input) {
  const double max_turn = DegToRad(input.options.max_corner_deg);
  std::vector<std::optional<Turn>> turns(curve.samples.size());
  for (std::size_t k = 0; k < turns.size(); ++k) {
    turns[k] = TurnAt(curve, k, max_turn, input.views);
  }
  const auto fits_best = [&](std::size_t k) {
    const auto around = SamplesAround(curve, k, kApartPx * turns[k]->pixel);
    return std::ranges::all_of(around, [&](const auto& other) {
      const auto& turn = turns[other.index];
      return !turn || std::pair(turns[k]->misfit_px, k) <=
                          std::pair(turn->misfit_px, other.index);
    });
  };
  std::vector<std::size_t> corners;
  for (std::size_t k = 0; k < turns.size(); ++k) {
    if (turns[k] && turns[k]->is_corner && fits_best(k)) {
      corners.push_back(k);
    }
  }
  return corners;
}

}  // namespace

std::vector<Curve> CutCorners(const std::vector<Curve>& curves,
                              const RefinementInput& input) {
  std::vector<std::vector<Curve>> pieces(curves.size());
  ParallelFor(curves.size(), input.num_threads, [&](std::size_t i) {
    pieces[i] = CutAt(curves[i], CornersOf(curves[i], input));
  });
  return Concatenate(std::move(pieces));
}

}  // namespace curvix
