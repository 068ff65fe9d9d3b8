// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "hypotheses/split_along_contours.h"

#include <cstddef>
#include <optional>

namespace curvix {

TwoTurns SplitAlongContours(const std::vector<std::int32_t>& edge_idxs,
                            const std::vector<EdgeNeighbors>& neighbors) {
  TwoTurns turns;
  std::vector<bool> is_first(neighbors.size(), false);
  const auto leads_to_first = [&](const std::optional<std::int32_t>& link) {
    return link && is_first[static_cast<std::size_t>(*link)];
  };
  for (const std::int32_t edge_idx : edge_idxs) {
    const auto i = static_cast<std::size_t>(edge_idx);
    if (leads_to_first(neighbors[i].previous) ||
        leads_to_first(neighbors[i].next)) {
      turns.second.push_back(edge_idx);
    } else {
      turns.first.push_back(edge_idx);
      is_first[i] = true;
    }
  }
  return turns;
}

}  // namespace curvix
