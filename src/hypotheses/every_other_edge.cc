// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "hypotheses/every_other_edge.h"

#include <cstddef>
#include <optional>

namespace curvix {

std::vector<std::int32_t> EveryOtherAlongContours(
    const std::vector<std::int32_t>& edge_idxs,
    const std::vector<EdgeNeighbors>& neighbors) {
  std::vector<std::int32_t> taken;
  std::vector<bool> is_taken(neighbors.size(), false);
  const auto leads_to_taken = [&](const std::optional<std::int32_t>& link) {
    return link && is_taken[static_cast<std::size_t>(*link)];
  };
  for (const std::int32_t edge_idx : edge_idxs) {
    const auto i = static_cast<std::size_t>(edge_idx);
    if (leads_to_taken(neighbors[i].previous) ||
        leads_to_taken(neighbors[i].next)) {
      continue;
    }
    taken.push_back(edge_idx);
    is_taken[i] = true;
  }
  return taken;
}

}  // namespace curvix
