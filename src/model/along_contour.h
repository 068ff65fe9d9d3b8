// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5 (the contours of images).
#pragma once

#include <curvix/edges.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace curvix {

// Calls `visit` with the index of every edge to which at most `num_links` links
// lead from `edge_idx` along its contour, on either side, nearest first.
template <typename F>
void ForEachAlongContour(const std::vector<EdgeNeighbors>& neighbors,
                         std::int32_t edge_idx,
                         int num_links,
                         const F& visit) {
  for (const auto side : {&EdgeNeighbors::previous, &EdgeNeighbors::next}) {
    std::int32_t at = edge_idx;
    for (int k = 0; k < num_links; ++k) {
      const std::optional<std::int32_t> next =
          neighbors[static_cast<std::size_t>(at)].*side;
      if (!next) break;
      at = *next;
      visit(at);
    }
  }
}

}  // namespace curvix
