// SPDX-License-Identifier: BSD-3-Clause
#include "model/contours.h"

#include <algorithm>

namespace curvix {
namespace {

using Link = std::optional<std::int32_t> EdgeNeighbors::*;

constexpr Link kNext = &EdgeNeighbors::next;
constexpr Link kPrevious = &EdgeNeighbors::previous;

// Appends the edges from `start` on along `ahead`, without it, as far as links
// are mutual and lead to edges that are on no contour yet.
void Follow(const std::vector<EdgeNeighbors>& neighbors,
            Link ahead,
            Link back,
            std::int32_t start,
            std::vector<bool>& is_taken,
            std::vector<std::int32_t>& edges) {
  std::int32_t at = start;
  while (const auto other = neighbors[static_cast<std::size_t>(at)].*ahead) {
    const auto j = static_cast<std::size_t>(*other);
    if (is_taken[j] || neighbors[j].*back != at) return;
    is_taken[j] = true;
    at = *other;
    edges.push_back(at);
  }
}

}  // namespace

Contours::Contours(const std::vector<EdgeNeighbors>& neighbors) {
  std::vector<bool> is_taken(neighbors.size(), false);
  edges_.reserve(neighbors.size());
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    if (is_taken[i]) continue;
    is_taken[i] = true;
    const auto start = static_cast<std::int32_t>(i);
    begins_.push_back(edges_.size());
    edges_.push_back(start);
    Follow(neighbors, kNext, kPrevious, start, is_taken, edges_);
    // What lies before it is found nearest first and belongs in front.
    const auto begin = static_cast<std::ptrdiff_t>(begins_.back());
    const auto behind = static_cast<std::ptrdiff_t>(edges_.size());
    Follow(neighbors, kPrevious, kNext, start, is_taken, edges_);
    std::reverse(edges_.begin() + behind, edges_.end());
    std::rotate(edges_.begin() + begin, edges_.begin() + behind, edges_.end());
  }
  begins_.push_back(edges_.size());
}

}  // namespace curvix
