// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "model/sample_runs.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace curvix {

std::vector<Run> RunsOf(const std::vector<bool>& kept) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!kept[i]) continue;
    if (i == 0 || !kept[i - 1]) runs.push_back({i, i});
    runs.back().end = i + 1;
  }
  return runs;
}

void OpenAtGap(Curve& curve, std::vector<bool>& kept) {
  const auto gap = std::find(kept.begin(), kept.end(), false);
  if (!curve.closed || gap == kept.end()) return;
  const auto offset = gap - kept.begin();
  std::rotate(curve.samples.begin(),
              curve.samples.begin() + offset,
              curve.samples.end());
  std::rotate(kept.begin(), gap, kept.end());
  curve.closed = false;
}

Curve TakeOut(Curve& curve, const Run& run) {
  if (run.begin == 0 && run.end == curve.samples.size()) {
    return std::move(curve);
  }
  const auto begin = std::make_move_iterator(curve.samples.begin());
  Curve part;
  part.samples.assign(begin + static_cast<std::ptrdiff_t>(run.begin),
                      begin + static_cast<std::ptrdiff_t>(run.end));
  return part;
}

std::vector<Curve> KeepRuns(Curve curve, std::vector<bool> kept) {
  OpenAtGap(curve, kept);
  std::vector<Curve> pieces;
  for (const Run& run : RunsOf(kept)) {
    if (run.end - run.begin >= 2) pieces.push_back(TakeOut(curve, run));
  }
  return pieces;
}

}  // namespace curvix
