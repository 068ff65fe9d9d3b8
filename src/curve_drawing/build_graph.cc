// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/build_graph.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"

namespace curvix {
namespace {

// Calls f(ref, i) for each support of each edge i, in order.
template <typename F>
void ForEachSupport(const std::vector<Edge3d>& edges, const F& f) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (const EdgeRef& ref : edges[i].support) {
      f(ref, static_cast<std::int32_t>(i));
    }
  }
}

// Counts become where each begins; the end is added.
void SumUp(std::vector<std::size_t>& counts) {
  std::size_t sum = 0;
  for (std::size_t& count : counts) {
    const std::size_t begin = sum;
    sum += count;
    count = begin;
  }
  counts.push_back(sum);
}

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

SupportIndex::SupportIndex(const std::vector<Edge3d>& edges) {
  ForEachSupport(edges, [&](const EdgeRef& ref, std::int32_t) {
    const auto view_idx = static_cast<std::size_t>(ref.view_idx);
    if (view_idx >= view_begins_.size()) view_begins_.resize(view_idx + 1, 0);
    view_begins_[view_idx] = std::max(
        view_begins_[view_idx], static_cast<std::size_t>(ref.edge_idx) + 1);
  });
  SumUp(view_begins_);
  // A counting sort keeps the order of the 3D edges.
  offsets_.assign(view_begins_.back(), 0);
  ForEachSupport(edges, [&](const EdgeRef& ref, std::int32_t) {
    ++offsets_[PlaceOf(ref)];
  });
  SumUp(offsets_);
  edge_idxs_.resize(offsets_.back());
  // Each offset moves on to the next one's place, and back again.
  ForEachSupport(edges, [&](const EdgeRef& ref, std::int32_t edge_idx) {
    edge_idxs_[offsets_[PlaceOf(ref)]++] = edge_idx;
  });
  std::rotate(offsets_.begin(), offsets_.end() - 1, offsets_.end());
  offsets_.front() = 0;
}

bool SupportIndex::IsKnown(const EdgeRef& ref) const {
  const auto view_idx = static_cast<std::size_t>(ref.view_idx);
  return ref.view_idx >= 0 && view_idx + 1 < view_begins_.size() &&
         ref.edge_idx >= 0 && PlaceOf(ref) < view_begins_[view_idx + 1];
}

std::span<const std::int32_t> SupportIndex::SupportedBy(
    const EdgeRef& ref) const {
  if (!IsKnown(ref)) return {};
  const std::size_t place = PlaceOf(ref);
  return {edge_idxs_.data() + offsets_[place],
          offsets_[place + 1] - offsets_[place]};
}

struct RankedLink {
  double distance = 0;  // squared, world
  NeighborLink link;

  friend bool operator<(const RankedLink& a, const RankedLink& b) {
    return std::tuple(-a.link.Weight(), a.distance, a.link.edge_idx) <
           std::tuple(-b.link.Weight(), b.distance, b.link.edge_idx);
  }
};

// The `max_size` heaviest links of `row`, the row of edges[edge_idx], in
// ascending order of edge_idx. Among equal weights the nearer edge comes first,
// then the smaller index.
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

const EdgeNeighbors& NeighborsOf(const std::vector<EdgeMap>& edge_maps,
                                 const EdgeRef& ref) {
  const auto view_idx = static_cast<std::size_t>(ref.view_idx);
  const auto edge_idx = static_cast<std::size_t>(ref.edge_idx);
  CURVIX_CHECK(view_idx < edge_maps.size() &&
                   edge_idx < edge_maps[view_idx].neighbors.size(),
               "view " << ref.view_idx << " has no edge " << ref.edge_idx);
  return edge_maps[view_idx].neighbors[edge_idx];
}

// Links each edge with those that the 2D edges `refs_of(ref)` of its supports
// support; `count` says how often.
template <typename RefsOf>
NeighborhoodGraph LinkBySupport(const std::vector<Edge3d>& edges,
                                const NeighborhoodOptions& options,
                                int num_threads,
                                std::int32_t NeighborLink::*count,
                                const RefsOf& refs_of) {
  const SupportIndex index(edges);
  const auto max_num_links = static_cast<std::size_t>(options.max_num_links);
  std::vector<std::vector<NeighborLink>> rows(edges.size());
  ParallelFor(edges.size(), num_threads, [&](std::size_t i) {
    std::vector<std::int32_t> others;
    for (const EdgeRef& support : edges[i].support) {
      for (const EdgeRef& ref : refs_of(support)) {
        const auto supported = index.SupportedBy(ref);
        others.insert(others.end(), supported.begin(), supported.end());
      }
    }
    std::sort(others.begin(), others.end());
    std::vector<NeighborLink> row;  // ascending
    for (const std::int32_t other : others) {
      if (static_cast<std::size_t>(other) == i) continue;
      if (row.empty() || row.back().edge_idx != other) row.push_back({other});
      ++(row.back().*count);
    }
    rows[i] = HeaviestLinks(edges, i, std::move(row), max_num_links);
    rows[i].shrink_to_fit();
  });
  return NeighborhoodGraph::FromRows(rows, num_threads);
}

}  // namespace

NeighborhoodGraph BuildGraph(const std::vector<Edge3d>& edges,
                             const NeighborhoodOptions& options,
                             int num_threads) {
  return LinkBySupport(edges,
                       options,
                       num_threads,
                       &NeighborLink::num_shared,
                       [](const EdgeRef& ref) { return std::array{ref}; });
}

NeighborhoodGraph LinkTangents(const std::vector<Edge3d>& edges,
                               const std::vector<EdgeMap>& edge_maps,
                               const NeighborhoodOptions& options,
                               int num_threads) {
  const auto refs_of = [&](const EdgeRef& ref) {
    std::vector<EdgeRef> refs;
    const EdgeNeighbors& neighbors = NeighborsOf(edge_maps, ref);
    for (const auto& neighbor : {neighbors.previous, neighbors.next}) {
      if (neighbor) refs.push_back({ref.view_idx, *neighbor});
    }
    return refs;
  };
  return LinkBySupport(
      edges, options, num_threads, &NeighborLink::num_tangential, refs_of);
}

}  // namespace curvix
