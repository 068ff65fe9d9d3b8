// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Junctions of curves that touch.
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
#include "curve_refinement/curve_ends.h"
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
                                const std::vector<PosedView>& views) {
  const Neighbors neighbors = FindNeighbors(curves, views);
  std::vector<Samples> taken(curves.size());
  std::vector<Samples> cuts(curves.size());
  for (const NearPair& touch : neighbors.touches) {
    const std::size_t a = touch.a.curve_idx, b = touch.b.curve_idx;
    if (taken[a].contains(touch.a.sample_idx) ||
        taken[b].contains(touch.b.sample_idx)) {
      continue;
    }
    const CurveSample& nearest = curves[a].samples[touch.a.sample_idx];
    const double pixel = PixelSize(nearest, views);
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

}  // namespace curvix
