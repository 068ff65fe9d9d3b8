// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "edge_detection/drop_masked_edges.h"

#include <algorithm>
#include <cmath>

namespace curvix {

std::int32_t DropMaskedEdges(const GrayImage& mask,
                             std::vector<LocatedEdge>* edges) {
  const auto is_masked = [&mask](const LocatedEdge& edge) {
    const double x = std::floor(edge.position.x());
    const double y = std::floor(edge.position.y());
    if (x < 0 || y < 0 || x >= mask.width || y >= mask.height) return false;
    return mask.at(static_cast<int>(x), static_cast<int>(y)) == 0;
  };
  const auto begin = std::remove_if(edges->begin(), edges->end(), is_masked);
  const auto num_masked = static_cast<std::int32_t>(edges->end() - begin);
  edges->erase(begin, edges->end());
  return num_masked;
}

}  // namespace curvix
