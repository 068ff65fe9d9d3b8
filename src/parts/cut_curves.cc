// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "parts/cut_curves.h"

#include <algorithm>
#include <cstddef>

#include "parts/runs.h"

namespace curvix {

std::vector<Curve> CutCurves(const std::vector<Curve>& curves,
                             const std::vector<Border>& core,
                             double overlap) {
  std::vector<Curve> pieces;
  for (Curve curve : curves) {
    const auto is_near = [&](const CurveSample& sample) {
      return DistanceBeyond(core, sample.position) <= overlap;
    };
    std::vector<bool> kept(curve.samples.size());
    std::transform(
        curve.samples.begin(), curve.samples.end(), kept.begin(), is_near);
    OpenAtGap(curve, kept);
    for (const Run& run : RunsOf(kept)) {
      if (run.end - run.begin >= 2) pieces.push_back(TakeOut(curve, run));
    }
  }
  return pieces;
}

}  // namespace curvix
