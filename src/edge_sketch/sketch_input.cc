// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/sketch_input.h"

#include "model/contours.h"

namespace curvix {

UsedEdges::UsedEdges(const std::vector<EdgeMap>& edge_maps) {
  for (const EdgeMap& map : edge_maps) {
    used_.emplace_back(map.edges.size(), false);
    num_unused_.push_back(static_cast<int>(map.edges.size()));
  }
}

void UsedEdges::Mark(const EdgeRef& ref) {
  const auto view_idx = static_cast<std::size_t>(ref.view_idx);
  const auto edge_idx = static_cast<std::size_t>(ref.edge_idx);
  if (used_[view_idx][edge_idx]) return;
  used_[view_idx][edge_idx] = true;
  --num_unused_[view_idx];
}

std::int64_t UsedEdges::total() const {
  std::int64_t total = 0;
  for (std::size_t i = 0; i < used_.size(); ++i) {
    total += static_cast<std::int64_t>(used_[i].size()) - num_unused_[i];
  }
  return total;
}

void MarkAlongContours(const std::vector<EdgeRef>& refs,
                       const std::vector<EdgeMap>& edge_maps,
                       int num_links,
                       UsedEdges& used) {
  for (const EdgeRef& ref : refs) {
    used.Mark(ref);
    ForEachAlongContour(
        edge_maps[static_cast<std::size_t>(ref.view_idx)].neighbors,
        ref.edge_idx,
        num_links,
        [&](std::int32_t edge_idx) {
          used.Mark({ref.view_idx, edge_idx});
        });
  }
}

}  // namespace curvix
