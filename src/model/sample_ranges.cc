// SPDX-License-Identifier: BSD-3-Clause
#include "model/sample_ranges.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace curvix {
namespace {

// A closed curve of which not all samples are kept becomes an open one that
// begins with one that is not; `kept` turns with it.
void OpenAtGap(Curve& curve, std::vector<bool>& kept) {
  const auto gap = std::ranges::find(kept, false);
  if (!curve.closed || gap == kept.end()) return;
  const auto offset = gap - kept.begin();
  std::rotate(curve.samples.begin(),
              curve.samples.begin() + offset,
              curve.samples.end());
  std::rotate(kept.begin(), gap, kept.end());
  curve.closed = false;
}

}  // namespace

std::vector<SampleRange> RangesOf(const std::vector<bool>& kept) {
  std::vector<SampleRange> ranges;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) continue;
    if (i == 0 || !kept[i - 1]) ranges.push_back({i, i});
    ranges.back().end = i + 1;
  }
  return ranges;
}

Curve TakeOut(Curve& curve, const SampleRange& range) {
  if (range.begin == 0 && range.end == curve.samples.size()) {
    return std::move(curve);
  }
  const auto begin = std::make_move_iterator(curve.samples.begin());
  Curve part;
  part.samples.assign(begin + static_cast<std::ptrdiff_t>(range.begin),
                      begin + static_cast<std::ptrdiff_t>(range.end));
  return part;
}

std::vector<Curve> KeepRanges(Curve curve,
                              std::vector<bool> kept,
                              std::size_t min_samples) {
  OpenAtGap(curve, kept);
  std::vector<Curve> curves;
  for (const SampleRange& range : RangesOf(kept)) {
    if (range.end - range.begin >= min_samples)
      curves.push_back(TakeOut(curve, range));
  }
  return curves;
}

std::vector<std::size_t> SamplesAlong(const Curve& curve,
                                      double spacing,
                                      std::size_t max_num) {
  std::vector<double> along = {0};
  for (std::size_t i = 1; i < curve.samples.size(); ++i) {
    along.push_back(
        along.back() +
        (curve.samples[i].position - curve.samples[i - 1].position).norm());
  }
  const double length = along.back();
  const auto num = std::min(
      max_num,
      static_cast<std::size_t>(std::max(1.0, std::floor(length / spacing))));
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < num; ++i) {
    const double at =
        length * (static_cast<double>(i) + 0.5) / static_cast<double>(num);
    const auto sample = static_cast<std::size_t>(
        std::lower_bound(along.begin(), along.end() - 1, at) - along.begin());
    if (chosen.empty() || chosen.back() != sample) chosen.push_back(sample);
  }
  return chosen;
}

namespace {

std::vector<SamplePlace> PlacesOf(const std::vector<Curve>& curves) {
  std::vector<SamplePlace> places;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    for (std::size_t s = 0; s < curves[c].samples.size(); ++s) {
      places.push_back({c, s});
    }
  }
  return places;
}

}  // namespace

SampleTree::SampleTree(const std::vector<Curve>& curves)
    : places_(PlacesOf(curves)), tree_(places_, [&](const SamplePlace& place) {
        return curves[place.curve_idx].samples[place.sample_idx].position;
      }) {}

}  // namespace curvix
