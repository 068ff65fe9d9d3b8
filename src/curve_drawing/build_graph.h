// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 5. Links between 3D edges that share 2D edges, and between
// those that follow each other along image contours.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "model/neighborhood_graph.h"

namespace curvix {

// The support lists of 3D edges, inverted. 8 bytes per 2D edge and 4 per
// support.
class SupportIndex {
 public:
  explicit SupportIndex(const std::vector<Edge3d>& edges);

  // The 3D edges that `ref` supports, ascending; empty if none.
  std::span<const std::int32_t> SupportedBy(const EdgeRef& ref) const;

 private:
  // Whether `ref` is within the edges that support anything, view by view.
  bool IsKnown(const EdgeRef& ref) const;
  std::size_t PlaceOf(const EdgeRef& ref) const {
    return view_begins_[static_cast<std::size_t>(ref.view_idx)] +
           static_cast<std::size_t>(ref.edge_idx);
  }

  // The index of each view's first edge, then the end; a view's edges count up
  // to the last that supports anything.
  std::vector<std::size_t> view_begins_;
  std::vector<std::size_t> offsets_;  // by place, into edge_idxs_, and the end
  std::vector<std::int32_t> edge_idxs_;
};

// The `max_size` heaviest links of `row`, the row of edges[edge_idx], in
// ascending order of edge_idx. Among equal weights the nearer edge comes first,
// then the smaller index.
std::vector<NeighborLink> HeaviestLinks(const std::vector<Edge3d>& edges,
                                        std::size_t edge_idx,
                                        std::vector<NeighborLink> row,
                                        std::size_t max_size);

// Fig. 6(a): links every two 3D edges that are supported by a common 2D edge;
// num_shared is how many they have in common.
//
// Each edge asks for its `options.max_num_links` heaviest links only, the
// nearer and then the smaller index first among equals; a link stays if either
// end asks for it. So there are at most max_num_links links per edge on
// average, however many 3D edges one 2D edge supports.
// Deviation: the paper has no such limit. It drops the lightest links of
// crowded edges, which hardly change the alignment.
//
// Time: the sum over 2D edges of the square of the number of 3D edges that each
// supports.
NeighborhoodGraph BuildGraph(const std::vector<Edge3d>& edges,
                             const NeighborhoodOptions& options,
                             int num_threads);

// Links two 3D edges if one has a 2D edge whose previous or next neighbour
// supports the other; num_tangential is in how many views. The full
// neighborhood graph is UnionOf(this, the links of shared 2D edges).
//
// Each edge asks for its options.max_num_links heaviest links, as in
// BuildGraph. `edge_maps` has one map per view, with the neighbours of each
// edge.
NeighborhoodGraph LinkTangents(const std::vector<Edge3d>& edges,
                               const std::vector<EdgeMap>& edge_maps,
                               const NeighborhoodOptions& options,
                               int num_threads);

}  // namespace curvix
