// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(c). Deviation: an edge supports a hypothesis if it is
// near the projected edge, given the covariance of the hypothesis, and each
// support improves the hypothesis; see docs/paper_map.md.
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

// A hypothesis with its support.
struct TrackedEdge {
  EdgeEstimate estimate;
  std::vector<EdgeRef> support;  // at most one per view, ascending
  double evidence = 0;           // log-likelihood ratio
};

// The views that are queried for hypotheses of one pair of hypothesis views.
struct ViewsToAsk {
  // The neighbours of the hypothesis views, then these themselves, which hardly
  // distinguish right hypotheses from wrong ones.
  std::vector<std::int32_t> first;
  std::vector<std::int32_t> all;  // ascending
  // Fewest supporting views of a hypothesis, the hypothesis views included.
  std::size_t fewest_supports = 3;
  // Whether views behind a surface have no vote (visible_side.h). For seeds:
  // the curve that grows from one is tested again.
  bool from_one_side = false;
};

// Fewest supporting views of an edge: options.min_num_support_views and the two
// hypothesis views, but at most just over half of `num_on_this_side`, and at
// least three. `num_on_this_side`: number of views that look from nearly the
// same direction as the first hypothesis view, itself included. The others may
// see nothing of what it sees.
std::size_t FewestSupports(const ValidationOptions& options,
                           std::size_t num_on_this_side);

// A quick test with each view's `presence`, before the estimate is made. False
// only if TrackSupport() would reject the edge in its first round whatever the
// covariance.
bool MayBeSupported(const SpaceEdge& edge,
                    const std::vector<ViewIndex>& views,
                    const ViewsToAsk& to_ask);

// Finds the support of `start`. Two rays determine a 3D edge to a few tenths of
// a pixel in their own views, and to several pixels in a view at a right angle.
// So each round queries the views in which the predicted standard deviation is
// below a bound, takes the nearest edge within the gate, and adjusts the
// estimate to all support found. The first round queries `to_ask.first` only
// and ends as soon as too few of them are left, since most hypotheses are
// wrong. Later rounds query `to_ask.all`. nullopt as soon as fewer than
// `to_ask.fewest_supports` views support it (in the first round: at most four),
// or if the log-likelihood ratio at the end is below
// options.min_log_likelihood_ratio. `sigma_px`: standard deviation of an edge's
// location.
std::optional<TrackedEdge> TrackSupport(const EdgeEstimate& start,
                                        const std::vector<ViewIndex>& views,
                                        const NeighborsByView& neighbors,
                                        const ViewsToAsk& to_ask,
                                        double sigma_px,
                                        const ValidationOptions& options);

// The edges that show `tracked` in those of `views_of_place` (ascending) that
// TrackSupport() did not query for it: at most one per view, ascending. They
// change neither the estimate nor its log-likelihood ratio.
std::vector<EdgeRef> FindMoreSupport(
    const TrackedEdge& tracked,
    const std::vector<ViewIndex>& views,
    const std::vector<std::int32_t>& views_of_place,
    const ViewsToAsk& asked,
    double sigma_px,
    const ValidationOptions& options);

}  // namespace curvix
