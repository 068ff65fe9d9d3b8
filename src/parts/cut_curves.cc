// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "parts/cut_curves.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "model/sample_runs.h"
#include "parts/regions.h"

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
    for (Curve& piece : KeepRuns(std::move(curve), std::move(kept))) {
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

TracedCurve TraceCurve(Curve curve, const std::vector<EdgeMap>& edge_maps) {
  TracedCurve traced{std::move(curve), {}};
  ForEachSupport(traced.curve, [&](EdgeRef& ref) {
    const EdgeMap& map = edge_maps[static_cast<std::size_t>(ref.view_idx)];
    traced.edges.push_back(map.edges[static_cast<std::size_t>(ref.edge_idx)]);
    ref.edge_idx = static_cast<std::int32_t>(traced.edges.size() - 1);
  });
  return traced;
}

}  // namespace curvix
