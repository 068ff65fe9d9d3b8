// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "edge_sketch/split_along_contours.h"

#include "model/contours.h"

namespace curvix {

TwoTurns SplitAlongContours(const std::vector<std::int32_t>& edge_idxs,
                            const std::vector<EdgeNeighbors>& neighbors,
                            int step) {
  TwoTurns turns;
  std::vector<bool> is_first(neighbors.size(), false);
  for (const std::int32_t edge_idx : edge_idxs) {
    bool leads_to_first = false;
    ForEachAlongContour(neighbors, edge_idx, step - 1, [&](std::int32_t other) {
      leads_to_first |= is_first[static_cast<std::size_t>(other)];
    });
    if (leads_to_first) {
      turns.second.push_back(edge_idx);
    } else {
      turns.first.push_back(edge_idx);
      is_first[static_cast<std::size_t>(edge_idx)] = true;
    }
  }
  return turns;
}

}  // namespace curvix
