// SPDX-License-Identifier: BSD-3-Clause
#include "model/sample_ranges.h"

#include <algorithm>
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

}  // namespace curvix
