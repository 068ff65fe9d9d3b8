// SPDX-License-Identifier: BSD-3-Clause
#include "model/neighborhood_graph.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "base/check.h"
#include "base/parallel.h"

namespace curvix {
namespace {

using Row = std::vector<NeighborLink>;

void CheckRow(const Row& row, std::size_t edge_idx, std::size_t num_edges) {
  std::int64_t last = -1;
  for (const NeighborLink& link : row) {
    const std::int64_t other = link.edge_idx;
    CURVIX_CHECK(other > last, "row " << edge_idx << " is not ascending");
    CURVIX_CHECK(other < static_cast<std::int64_t>(num_edges) &&
                     other != static_cast<std::int64_t>(edge_idx),
                 "link from " << edge_idx << " to " << other);
    last = other;
  }
}

// The links that other rows have to a row, ascending, for all rows.
class Transposed {
 public:
  explicit Transposed(const std::vector<Row>& rows)
      : begins_(rows.size() + 1, 0) {
    for (const Row& row : rows) {
      for (const NeighborLink& link : row) ++begins_[After(link)];
    }
    for (std::size_t i = 1; i < begins_.size(); ++i) {
      begins_[i] += begins_[i - 1];
    }
    links_.resize(begins_.back());
    std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      for (NeighborLink link : rows[i]) {
        std::size_t& place = next[After(link) - 1];
        link.edge_idx = static_cast<std::int32_t>(i);
        links_[place++] = link;
      }
    }
  }

  std::span<const NeighborLink> operator[](std::size_t i) const {
    return {links_.data() + begins_[i], begins_[i + 1] - begins_[i]};
  }

 private:
  static std::size_t After(const NeighborLink& link) {
    return static_cast<std::size_t>(link.edge_idx) + 1;
  }

  std::vector<std::size_t> begins_;
  std::vector<NeighborLink> links_;
};

// How many different edges the links of `a` and `b`, both ascending, name.
std::size_t UnionSize(std::span<const NeighborLink> a,
                      std::span<const NeighborLink> b) {
  std::size_t size = a.size() + b.size();
  auto y = b.begin();
  for (const NeighborLink& link : a) {
    while (y != b.end() && y->edge_idx < link.edge_idx) ++y;
    if (y != b.end() && y->edge_idx == link.edge_idx) --size;
  }
  return size;
}

// Writes the links of `a` and `b`, both ascending, to `out`; links in both are
// combined.
template <typename Combine, typename Output>
void MergeRows(std::span<const NeighborLink> a,
               std::span<const NeighborLink> b,
               const Combine& combine,
               Output out) {
  auto x = a.begin();
  auto y = b.begin();
  while (x != a.end() || y != b.end()) {
    if (y == b.end() || (x != a.end() && x->edge_idx < y->edge_idx)) {
      *out++ = *x++;
    } else if (x == a.end() || y->edge_idx < x->edge_idx) {
      *out++ = *y++;
    } else {
      *out++ = combine(*x++, *y++);
    }
  }
}

NeighborLink LargerCounts(const NeighborLink& a, const NeighborLink& b) {
  return {a.edge_idx,
          std::max(a.num_shared, b.num_shared),
          std::max(a.num_tangential, b.num_tangential)};
}

NeighborLink AddedCounts(const NeighborLink& a, const NeighborLink& b) {
  return {a.edge_idx,
          a.num_shared + b.num_shared,
          a.num_tangential + b.num_tangential};
}

// Brings `row` into ascending order, counts of repeats added.
void SortAndAdd(Row& row) {
  std::ranges::sort(row, {}, &NeighborLink::edge_idx);
  std::size_t size = 0;
  for (const NeighborLink& link : row) {
    if (size > 0 && row[size - 1].edge_idx == link.edge_idx) {
      row[size - 1] = AddedCounts(row[size - 1], link);
    } else {
      row[size++] = link;
    }
  }
  row.resize(size);
}

}  // namespace

NeighborhoodGraph NeighborhoodGraph::FromRows(const std::vector<Row>& rows,
                                              int num_threads) {
  ParallelFor(rows.size(), num_threads, [&](std::size_t i) {
    CheckRow(rows[i], i, rows.size());
  });
  const Transposed transposed(rows);
  NeighborhoodGraph graph;
  graph.offsets_.assign(rows.size() + 1, 0);
  ParallelFor(rows.size(), num_threads, [&](std::size_t i) {
    graph.offsets_[i + 1] = UnionSize(rows[i], transposed[i]);
  });
  std::partial_sum(
      graph.offsets_.begin(), graph.offsets_.end(), graph.offsets_.begin());
  graph.links_.resize(graph.offsets_.back());
  ParallelFor(rows.size(), num_threads, [&](std::size_t i) {
    MergeRows(rows[i],
              transposed[i],
              LargerCounts,
              graph.links_.data() + graph.offsets_[i]);
  });
  return graph;
}

NeighborhoodGraph NeighborhoodGraph::Filter(
    const std::function<bool(std::size_t, const NeighborLink&)>& keep,
    int num_threads) const {
  std::vector<Row> rows(NumEdges());
  ParallelFor(NumEdges(), num_threads, [&](std::size_t i) {
    for (const NeighborLink& link : Neighbors(i)) {
      if (static_cast<std::size_t>(link.edge_idx) > i && keep(i, link)) {
        rows[i].push_back(link);
      }
    }
  });
  return FromRows(rows, num_threads);
}

NeighborhoodGraph UnionOf(const NeighborhoodGraph& a,
                          const NeighborhoodGraph& b,
                          int num_threads) {
  CURVIX_CHECK(a.NumEdges() == b.NumEdges(),
               a.NumEdges() << " and " << b.NumEdges() << " edges");
  std::vector<Row> rows(a.NumEdges());
  ParallelFor(rows.size(), num_threads, [&](std::size_t i) {
    MergeRows(a.Neighbors(i),
              b.Neighbors(i),
              AddedCounts,
              std::back_inserter(rows[i]));
  });
  return NeighborhoodGraph::FromRows(rows, num_threads);
}

NeighborhoodGraph Contract(const NeighborhoodGraph& graph,
                           const std::vector<std::int32_t>& group_of,
                           std::size_t num_groups,
                           int num_threads) {
  CURVIX_CHECK(group_of.size() == graph.NumEdges(),
               group_of.size()
                   << " groups for " << graph.NumEdges() << " edges");
  std::vector<Row> rows(num_groups);
  for (std::size_t i = 0; i < group_of.size(); ++i) {
    const auto group = static_cast<std::size_t>(group_of[i]);
    CURVIX_CHECK(group < num_groups, "group " << group_of[i]);
    for (NeighborLink link : graph.Neighbors(i)) {
      link.edge_idx = group_of[static_cast<std::size_t>(link.edge_idx)];
      if (link.edge_idx != group_of[i]) rows[group].push_back(link);
    }
  }
  ParallelFor(
      num_groups, num_threads, [&](std::size_t i) { SortAndAdd(rows[i]); });
  return NeighborhoodGraph::FromRows(rows, num_threads);
}

}  // namespace curvix
