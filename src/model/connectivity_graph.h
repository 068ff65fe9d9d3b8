// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 6. The connectivity graph of 3D edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace curvix {

// At most one neighbour on either side of each edge. `flipped[i]` says that the
// tangent of edge i is to be reversed; forward and backward refer to the
// tangents after that. Every connected component is a chain or a ring.
struct ConnectivityGraph {
  std::vector<std::optional<std::int32_t>> forward;
  std::vector<std::optional<std::int32_t>> backward;
  std::vector<bool> flipped;

  std::size_t NumEdges() const { return forward.size(); }
};

// Throws std::logic_error unless
//  1. the three vectors are equally long and all indices are in range;
//  2. forward[i] == j exactly if backward[j] == i (links are mutual);
//  3. no edge is its own neighbour.
void Validate(const ConnectivityGraph& graph);

}  // namespace curvix
