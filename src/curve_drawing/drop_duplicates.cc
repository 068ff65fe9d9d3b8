// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/drop_duplicates.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/angles.h"
#include "curve_drawing/connect_edges.h"
#include "geometry/image_edge.h"
#include "geometry/pixel_size.h"
#include "model/sample_ranges.h"
#include "model/sample_tree.h"

namespace curvix {
namespace {

// Samples of one curve that are no more apart than this never repeat each
// other.
constexpr std::size_t kMinLoop = 6;

// All samples of all curves, which of them stay, and which are near.
class SampleFilter {
 public:
  SampleFilter(const std::vector<Curve>& curves,
               const std::vector<PosedView>& views,
               const ConnectivityOptions& options)
      : curves_(curves),
        views_(views),
        options_(options),
        samples_(curves),
        stays_(samples_.Places().size(), false) {}

  // Decides on sample `k` in the order of curves and samples.
  void Visit(std::size_t k) { stays_[k] = !IsDuplicate(k); }
  bool Stays(std::size_t k) const { return stays_[k]; }

 private:
  const CurveSample& Sample(std::size_t k) const {
    const SamplePlace& place = samples_.Places()[k];
    return curves_[place.curve_idx].samples[place.sample_idx];
  }
  bool AreNeighbors(std::size_t k, std::size_t j) const {
    const SamplePlace& a = samples_.Places()[k];
    const SamplePlace& b = samples_.Places()[j];
    if (a.curve_idx != b.curve_idx) return false;
    const std::size_t gap = std::max(a.sample_idx, b.sample_idx) -
                            std::min(a.sample_idx, b.sample_idx);
    const Curve& curve = curves_[a.curve_idx];
    return gap < kMinLoop ||
           (curve.closed && curve.samples.size() - gap < kMinLoop);
  }
  bool IsDuplicate(std::size_t k) const {
    const CurveSample& sample = Sample(k);
    const double unit = PixelSize(sample, views_);
    const double max_normal = options_.max_duplicate_distance_px * unit;
    const double max_along = options_.sample_spacing_px * unit;
    const double radius = std::hypot(max_normal, max_along);
    for (const std::size_t j : samples_.Within(sample.position, radius)) {
      if (!stays_[j] || AreNeighbors(k, j)) continue;
      const EdgeDistances between = MeasureDistances(sample, Sample(j));
      if (between.normal <= max_normal && between.tangential <= max_along &&
          between.angle <= DegToRad(options_.max_angle_deg)) {
        return true;
      }
    }
    return false;
  }

  const std::vector<Curve>& curves_;
  const std::vector<PosedView>& views_;
  const ConnectivityOptions& options_;
  SampleTree samples_;
  std::vector<bool> stays_;
};

// Curve indices by decreasing length.
std::vector<std::size_t> ByLength(const std::vector<Curve>& curves,
                                  const std::vector<PosedView>& views) {
  std::vector<double> lengths;
  for (const Curve& curve : curves) {
    lengths.push_back(LengthInPixels(curve, views));
  }
  std::vector<std::size_t> order(curves.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
    return lengths[a] > lengths[b];
  });
  return order;
}

}  // namespace

std::vector<Curve> DropDuplicates(std::vector<Curve> curves,
                                  const std::vector<PosedView>& views,
                                  const ConnectivityOptions& options) {
  if (!(options.max_duplicate_distance_px > 0)) return curves;
  std::vector<std::size_t> bases;
  std::size_t num_samples = 0;
  for (const Curve& curve : curves) {
    bases.push_back(num_samples);
    num_samples += curve.samples.size();
  }
  SampleFilter filter(curves, views, options);
  for (const std::size_t c : ByLength(curves, views)) {
    for (std::size_t s = 0; s < curves[c].samples.size(); ++s) {
      filter.Visit(bases[c] + s);
    }
  }
  std::vector<Curve> kept;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    std::vector<bool> stays;
    for (std::size_t s = 0; s < curves[c].samples.size(); ++s) {
      stays.push_back(filter.Stays(bases[c] + s));
    }
    std::vector<Curve> pieces = KeepRanges(curves[c], std::move(stays), 1);
    std::move(pieces.begin(), pieces.end(), std::back_inserter(kept));
  }
  return kept;
}

}  // namespace curvix
