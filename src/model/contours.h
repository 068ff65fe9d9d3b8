// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5 (the contours of images).
#pragma once

#include <curvix/edges.h>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace curvix {

// The contours of a view: edges joined by mutual links. Each edge is on one of
// them.
class Contours {
 public:
  explicit Contours(const std::vector<EdgeNeighbors>& neighbors);

  // Contours are in the order of their first edges.
  std::size_t size() const { return begins_.size() - 1; }
  // Its edges from one end to the other; of a closed contour, from the first
  // edge on.
  std::span<const std::int32_t> operator[](std::size_t contour) const {
    const std::size_t begin = begins_[contour];
    return {edges_.data() + begin, begins_[contour + 1] - begin};
  }

 private:
  std::vector<std::int32_t> edges_;  // contour by contour
  std::vector<std::size_t> begins_;  // of each contour, and the end
};

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
