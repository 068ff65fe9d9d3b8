// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering).
#include "parts/move_support.h"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/check.h"

namespace curvix {
namespace {

std::size_t Idx(std::int32_t idx) { return static_cast<std::size_t>(idx); }

template <typename F>
void ForEachRef(std::vector<Curve>& curves, const F& f) {
  for (Curve& curve : curves) {
    for (CurveSample& sample : curve.samples) {
      for (EdgeRef& ref : sample.support) f(ref);
    }
  }
}

}  // namespace

std::vector<EdgeMap> KeepSupport(const std::vector<EdgeMap>& edge_maps,
                                 std::vector<Curve>& curves) {
  constexpr std::int32_t kUnused = -1;
  constexpr std::int32_t kUsed = 0;
  std::vector<std::vector<std::int32_t>> new_idxs;
  for (const EdgeMap& map : edge_maps) {
    new_idxs.emplace_back(map.edges.size(), kUnused);
  }
  ForEachRef(curves, [&](const EdgeRef& ref) {
    new_idxs[Idx(ref.view_idx)][Idx(ref.edge_idx)] = kUsed;
  });
  std::vector<EdgeMap> kept(edge_maps.size());
  for (std::size_t view = 0; view < edge_maps.size(); ++view) {
    std::vector<Edge2d>& edges = kept[view].edges;
    for (std::size_t i = 0; i < new_idxs[view].size(); ++i) {
      if (new_idxs[view][i] == kUnused) continue;
      new_idxs[view][i] = static_cast<std::int32_t>(edges.size());
      edges.push_back(edge_maps[view].edges[i]);
    }
  }
  ForEachRef(curves, [&](EdgeRef& ref) {
    ref.edge_idx = new_idxs[Idx(ref.view_idx)][Idx(ref.edge_idx)];
  });
  return kept;
}

void MoveSupport(PartResult& part,
                 const std::vector<int>& view_idxs,
                 std::vector<EdgeMap>& scene_edge_maps) {
  CURVIX_CHECK(part.edge_maps.size() == view_idxs.size(),
               "one edge map per view of a part");
  std::vector<std::int32_t> first_edges;
  for (std::size_t i = 0; i < view_idxs.size(); ++i) {
    EdgeMap& map = scene_edge_maps[Idx(view_idxs[i])];
    const std::vector<Edge2d>& edges = part.edge_maps[i].edges;
    first_edges.push_back(static_cast<std::int32_t>(map.edges.size()));
    map.edges.insert(map.edges.end(), edges.begin(), edges.end());
  }
  ForEachRef(part.curves, [&](EdgeRef& ref) {
    ref.edge_idx += first_edges[Idx(ref.view_idx)];
    ref.view_idx = view_idxs[Idx(ref.view_idx)];
  });
}

}  // namespace curvix
