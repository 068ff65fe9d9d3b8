// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "neighborhood/heaviest_links.h"

#include <algorithm>
#include <cstdint>
#include <tuple>

namespace curvix {
namespace {

struct RankedLink {
  double distance = 0;  // squared, world
  NeighborLink link;

  friend bool operator<(const RankedLink& a, const RankedLink& b) {
    return std::tuple(-a.link.Weight(), a.distance, a.link.edge_idx) <
           std::tuple(-b.link.Weight(), b.distance, b.link.edge_idx);
  }
};

}  // namespace

std::vector<NeighborLink> HeaviestLinks(const std::vector<Edge3d>& edges,
                                        std::size_t edge_idx,
                                        std::vector<NeighborLink> row,
                                        std::size_t max_size) {
  if (row.size() <= max_size) return row;
  const Eigen::Vector3d& position = edges[edge_idx].position;
  std::vector<RankedLink> ranked;
  ranked.reserve(row.size());
  for (const NeighborLink& link : row) {
    const Edge3d& other = edges[static_cast<std::size_t>(link.edge_idx)];
    ranked.push_back({(other.position - position).squaredNorm(), link});
  }
  const auto end = ranked.begin() + static_cast<std::ptrdiff_t>(max_size);
  std::nth_element(ranked.begin(), end, ranked.end());
  row.clear();
  for (auto kept = ranked.begin(); kept != end; ++kept) {
    row.push_back(kept->link);
  }
  std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) {
    return a.edge_idx < b.edge_idx;
  });
  return row;
}

}  // namespace curvix
