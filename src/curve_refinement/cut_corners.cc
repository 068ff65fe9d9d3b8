// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Corners that are too blunt to see before the fit.
#include "curve_refinement/refine_curves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/parallel.h"
#include "curve_refinement/curve_ends.h"
#include "geometry/directions.h"
#include "geometry/pixel_size.h"
#include "model/curve_chains.h"

namespace curvix {
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
                                   double max_turn,
                                   const std::vector<PosedView>& views) {
  std::vector<std::optional<Turn>> turns(curve.samples.size());
  for (std::size_t k = 0; k < turns.size(); ++k) {
    turns[k] = TurnAt(curve, k, max_turn, views);
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
                              const std::vector<PosedView>& views,
                              const CurveRefinementOptions& options,
                              int num_threads) {
  std::vector<std::vector<Curve>> pieces(curves.size());
  ParallelFor(curves.size(), num_threads, [&](std::size_t i) {
    pieces[i] =
        CutAt(curves[i],
              CornersOf(curves[i], DegToRad(options.max_corner_deg), views));
  });
  return Concatenate(std::move(pieces));
}

}  // namespace curvix
