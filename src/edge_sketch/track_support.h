// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(c). Deviation: support is judged by the distance of an
// edge from the projected one, against what is known of the hypothesis so far,
// and each support improves the hypothesis; see docs/paper_map.md.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <cstdint>
#include <optional>
#include <vector>

#include "edge_sketch/evidence.h"
#include "edge_sketch/view_index.h"
#include "geometry/adjust_edge.h"

namespace curvix {

// A hypothesis that found its support.
struct TrackedEdge {
  EdgeEstimate estimate;
  std::vector<EdgeRef> support;  // at most one per view, ascending
  double evidence = 0;           // Evidence()
};

// Which views to ask about hypotheses of one pair of hypothesis views.
struct QueryViews {
  // The views next to the hypothesis views, then these themselves, which hardly
  // ever tell a wrong hypothesis from a right one.
  std::vector<std::int32_t> first;
  std::vector<std::int32_t> all;  // ascending
  // So many of them must support a hypothesis, the hypothesis views included.
  std::size_t fewest_supports = 3;
};

// How far from a projected edge its support may be along the tangent; across it
// options.max_distance_px. Also the reach of each view's `presence`.
inline constexpr double kMaxSupportSlidePx = 1;

// How many views must support an edge: options.min_num_support_views and the
// two hypothesis views, but no more than just over half of those on one side,
// and never fewer than three. `num_on_this_side`: the views that look from
// nearly the same direction as the first hypothesis view, itself included; the
// others may see nothing of what it sees.
std::size_t FewestSupports(const ValidationOptions& options,
                           std::size_t num_on_this_side);

// False only if TrackSupport() would end in its first round whatever the
// estimate's covariance: a look at each view's `presence`, before the estimate
// is made.
bool MayBeSupported(const SpaceEdge& edge,
                    const std::vector<ViewIndex>& views,
                    const QueryViews& to_ask);

// Looks for the support of `start`. Two rays fix a 3D edge to a few tenths of a
// pixel in their own views and to several pixels in a view at a right angle; so
// each round asks the views in which the estimate's predicted standard
// deviation is below a bound, takes the nearest edge within the gate, and
// adjusts the estimate to all support found. The first round asks
// `to_ask.first` only, and ends as soon as too few of them are left: most
// hypotheses are wrong, and that shows there. Later rounds ask `to_ask.all`.
// nullopt as soon as fewer than `to_ask.fewest_supports` views support it, of
// the first round's no more than four, or when in the end the evidence is below
// options.min_evidence. `sigma_px`: standard deviation of an edge's location.
std::optional<TrackedEdge> TrackSupport(
    const EdgeEstimate& start,
    const std::vector<ViewIndex>& views,
    const std::vector<std::vector<ViewNeighbor>>& neighbors,
    const QueryViews& to_ask,
    double sigma_px,
    const ValidationOptions& options);

// The edges that show `tracked` in the views of `asked`, which TrackSupport()
// need not have asked: at most one per view, ascending. They have no part in
// the estimate and in its evidence.
std::vector<EdgeRef> FindMoreSupport(const EdgeEstimate& tracked,
                                     const std::vector<ViewIndex>& views,
                                     const std::vector<std::int32_t>& asked,
                                     double sigma_px,
                                     const ValidationOptions& options);

}  // namespace curvix
