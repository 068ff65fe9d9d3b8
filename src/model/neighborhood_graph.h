// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5, Fig. 6. The weighted neighborhood graph of 3D edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace curvix {

// One end of a link: the edge at the other end and why they are linked.
struct NeighborLink {
  std::int32_t edge_idx = 0;
  std::int32_t num_shared = 0;      // 2D edges that support both
  std::int32_t num_tangential = 0;  // 2D neighbour links between their supports

  // The weight of the link; at least one.
  std::int32_t Weight() const { return num_shared + num_tangential; }
  friend bool operator==(const NeighborLink&, const NeighborLink&) = default;
};

// An undirected weighted graph over edges 0..NumEdges()-1 in compressed rows,
// 24 bytes per link. Invariants (checked by FromRows):
//  1. every row is in ascending order of edge_idx, without repeats;
//  2. no edge is linked to itself;
//  3. j is in row i exactly if i is in row j, with the same counts.
class NeighborhoodGraph {
 public:
  NeighborhoodGraph() = default;

  // rows[i] lists links of edge i, ascending, without repeats. A link may be
  // given at one end only, or at both with different counts: the larger counts
  // hold.
  static NeighborhoodGraph FromRows(
      const std::vector<std::vector<NeighborLink>>& rows, int num_threads);

  std::size_t NumEdges() const { return offsets_.size() - 1; }
  std::size_t NumLinks() const { return links_.size() / 2; }
  std::span<const NeighborLink> Neighbors(std::size_t edge_idx) const {
    return {links_.data() + offsets_[edge_idx],
            offsets_[edge_idx + 1] - offsets_[edge_idx]};
  }

  // The links for which keep(i, link to j) holds. It is asked once per link,
  // with i < j, and must not depend on the order of calls.
  NeighborhoodGraph Filter(
      const std::function<bool(std::size_t, const NeighborLink&)>& keep,
      int num_threads) const;

  friend bool operator==(const NeighborhoodGraph&,
                         const NeighborhoodGraph&) = default;

 private:
  std::vector<std::size_t> offsets_ = {0};
  std::vector<NeighborLink> links_;
};

// The links of both, counts added. Both must have the same number of edges.
NeighborhoodGraph UnionOf(const NeighborhoodGraph& a,
                          const NeighborhoodGraph& b,
                          int num_threads);

// The graph of groups of edges: group_of[i] in [0, num_groups) is the group of
// edge i. Counts of links between two groups are added; links within one
// vanish.
NeighborhoodGraph Contract(const NeighborhoodGraph& graph,
                           const std::vector<std::int32_t>& group_of,
                           std::size_t num_groups,
                           int num_threads);

}  // namespace curvix
