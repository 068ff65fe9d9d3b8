// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/sketch_input.h"

#include <utility>

#include "base/median.h"
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

namespace {

double MedianStrength(const EdgeMap& map) {
  std::vector<double> strengths;
  strengths.reserve(map.edges.size());
  for (const Edge2d& edge : map.edges) {
    strengths.push_back(static_cast<double>(edge.strength));
  }
  return MedianOr(0, std::move(strengths));
}

}  // namespace

std::vector<bool> AreSeedCandidates(const EdgeMap& map,
                                    const Options& options) {
  const Contours contours(map.neighbors);
  const double least =
      options.edge_detection.min_contour_edges * MedianStrength(map);
  std::vector<bool> are_candidates(map.edges.size());
  for (std::size_t i = 0; i < contours.size(); ++i) {
    double sum = 0;
    for (const std::int32_t edge_idx : contours[i]) {
      sum += static_cast<double>(
          map.edges[static_cast<std::size_t>(edge_idx)].strength);
    }
    if (sum < least) continue;
    for (const std::int32_t edge_idx : contours[i]) {
      const auto k = static_cast<std::size_t>(edge_idx);
      are_candidates[k] = !options.curve_growth.IsTexture(
          static_cast<double>(map.edges[k].crowding));
    }
  }
  return are_candidates;
}

std::vector<std::int32_t> QueryEdges(const SketchInput& input,
                                     int view_idx,
                                     const UsedEdges& used) {
  const EdgeMap& map = input.edge_maps[static_cast<std::size_t>(view_idx)];
  const std::vector<bool> are_candidates =
      input.finds_seeds ? AreSeedCandidates(map, input.options)
                        : std::vector<bool>(map.edges.size(), true);
  const std::size_t step = input.h1_step;
  std::vector<std::int32_t> edge_idxs;
  for (std::size_t i = step / 2; i < map.edges.size(); i += step) {
    const auto edge_idx = static_cast<std::int32_t>(i);
    if (are_candidates[i] && !used.Contains({view_idx, edge_idx})) {
      edge_idxs.push_back(edge_idx);
    }
  }
  return edge_idxs;
}

int LinksBetweenQueries(const SketchInput& input) {
  if (input.finds_seeds) return 8;
  return AreCrowded(input.edge_maps) ? 4 : 2;
}

TwoTurns SplitAlongContours(const std::vector<std::int32_t>& edge_idxs,
                            const std::vector<EdgeNeighbors>& neighbors,
                            int step) {
  TwoTurns turns;
  std::vector<bool> is_first(neighbors.size(), false);
  for (const std::int32_t edge_idx : edge_idxs) {
    bool leads_to_first = false;
    ForEachAlongContour(neighbors, edge_idx, step - 1, [&](std::int32_t other) {
      leads_to_first |= is_first[static_cast<std::size_t>(other)];
    });
    if (leads_to_first) {
      turns.second.push_back(edge_idx);
    } else {
      turns.first.push_back(edge_idx);
      is_first[static_cast<std::size_t>(edge_idx)] = true;
    }
  }
  return turns;
}

}  // namespace curvix
