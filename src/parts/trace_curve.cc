// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "parts/trace_curve.h"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace curvix {

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
