// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering), after Sec. 6. Curves drawn once.
#include "curve_drawing/group_edges.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/angles.h"
#include "curve_drawing/link_edges.h"
#include "geometry/pixel_size.h"
#include "model/sample_ranges.h"

namespace curvix {
namespace {

// Samples of one curve that are no more apart than this never repeat each
// other.
constexpr std::size_t kMinLoop = 6;

bool AreNeighbors(const SamplePlace& a,
                  const SamplePlace& b,
                  const std::vector<Curve>& curves) {
  if (a.curve_idx != b.curve_idx) return false;
  const std::size_t gap = std::max(a.sample_idx, b.sample_idx) -
                          std::min(a.sample_idx, b.sample_idx);
  const Curve& curve = curves[a.curve_idx];
  return gap < kMinLoop ||
         (curve.closed && curve.samples.size() - gap < kMinLoop);
}

// Curve indices by decreasing length.
std::vector<std::size_t> ByLength(const std::vector<Curve>& curves,
                                  const std::vector<PosedView>& views) {
  std::vector<double> lengths;
  for (const Curve& curve : curves) {
    lengths.push_back(LengthInPixels(curve, views));
  }
  std::vector<std::size_t> order(curves.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, std::greater<>(), [&](std::size_t c) { return lengths[c]; });
  return order;
}

}  // namespace

std::vector<Curve> DropDuplicates(std::vector<Curve> curves,
                                  const std::vector<PosedView>& views,
                                  const ConnectivityOptions& options) {
  if (!(options.max_duplicate_distance_px > 0)) return curves;
  const SampleTree samples(curves);
  const auto sample_at = [&](const SamplePlace& place) -> const CurveSample& {
    return curves[place.curve_idx].samples[place.sample_idx];
  };
  // By curve and sample: whether it was visited and stays.
  std::vector<std::vector<bool>> stays;
  for (const Curve& curve : curves) {
    stays.emplace_back(curve.samples.size(), false);
  }
  const auto is_duplicate = [&](const SamplePlace& place) {
    const CurveSample& sample = sample_at(place);
    const double unit = PixelSize(sample, views);
    const double max_normal = options.max_duplicate_distance_px * unit;
    const double max_along = options.sample_spacing_px * unit;
    const std::vector<std::size_t> near =
        samples.Within(sample.position, std::hypot(max_normal, max_along));
    return std::ranges::any_of(near, [&](std::size_t i) {
      const SamplePlace& other = samples.Places()[i];
      if (!stays[other.curve_idx][other.sample_idx] ||
          AreNeighbors(place, other, curves)) {
        return false;
      }
      const EdgeDistances between = MeasureDistances(sample, sample_at(other));
      return between.normal <= max_normal && between.tangential <= max_along &&
             between.angle <= DegToRad(options.max_angle_deg);
    });
  };
  for (const std::size_t c : ByLength(curves, views)) {
    for (std::size_t s = 0; s < curves[c].samples.size(); ++s) {
      stays[c][s] = !is_duplicate({c, s});
    }
  }
  std::vector<Curve> kept;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    std::ranges::move(KeepRanges(std::move(curves[c]), std::move(stays[c]), 1),
                      std::back_inserter(kept));
  }
  return kept;
}

}  // namespace curvix
