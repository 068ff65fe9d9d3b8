// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(c).
#include "validation/track_support.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "geometry/image_edge.h"

namespace curvix {
namespace {

constexpr int kNumRounds = 4;
// Views in which the estimate may be off by more are not asked yet. Pixels.
constexpr double kMaxPredictedSigmaPx = 0.7;
constexpr int kFewestAfterFirstRound = 4;

struct Support {
  std::vector<EdgeRef> refs;
  std::vector<PlaneMeasurement> measurements;
  std::vector<ViewVote> votes;  // by view
};

Gate MakeGate(double predicted_sigma_px,
              double sigma_px,
              const ValidationOptions& options) {
  Gate gate;
  gate.normal_px =
      std::min(options.max_distance_px,
               2.5 * std::hypot(predicted_sigma_px, sigma_px) + sigma_px);
  gate.tangential_px = 1.0;
  gate.min_cosine = std::cos(DegToRad(options.max_angle_deg));
  return gate;
}

Support FindSupport(const EdgeEstimate& estimate,
                    const std::vector<ViewIndex>& views,
                    double sigma_px,
                    const ValidationOptions& options) {
  Support support;
  support.votes.resize(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const ViewIndex& view = views[i];
    const auto projected = ProjectEdge(*view.view, estimate.edge);
    if (!projected || !view.view->Contains(projected->position)) continue;
    const double predicted = PredictedSigmaPx(estimate, *view.view, *projected);
    if (predicted > kMaxPredictedSigmaPx) continue;
    const Gate gate = MakeGate(predicted, sigma_px, options);
    const auto nearest = NearestEdge(view, *projected, gate);
    ViewVote& vote = support.votes[i];
    vote.asked = true;
    vote.supported = nearest.has_value();
    vote.chance = view.density.ChanceOfSupport(
        projected->position,
        std::atan2(projected->tangent.y(), projected->tangent.x()),
        gate.normal_px);
    if (!nearest) continue;
    support.refs.push_back({static_cast<std::int32_t>(i), *nearest});
    support.measurements.push_back(MeasurePlane(
        *view.view,
        ToImageEdge(view.edges->edges[static_cast<std::size_t>(*nearest)])));
  }
  return support;
}

}  // namespace

std::optional<TrackedEdge> TrackSupport(
    const EdgeEstimate& start,
    const std::vector<ViewIndex>& views,
    const std::vector<std::vector<ViewNeighbor>>& neighbors,
    double sigma_px,
    const ValidationOptions& options) {
  TrackedEdge tracked;
  tracked.estimate = start;
  Support support;
  for (int round = 0; round < kNumRounds; ++round) {
    support = FindSupport(tracked.estimate, views, sigma_px, options);
    if (static_cast<int>(support.refs.size()) < kFewestAfterFirstRound) {
      return std::nullopt;
    }
    tracked.estimate =
        AdjustEdge(tracked.estimate.edge, support.measurements, sigma_px);
    // Settled: further rounds would ask the same views.
    if (tracked.support == support.refs) break;
    tracked.support = support.refs;
  }
  if (static_cast<int>(tracked.support.size()) <
      options.min_num_support_views + 2) {
    return std::nullopt;
  }
  tracked.evidence = Evidence(support.votes, neighbors);
  if (tracked.evidence < options.min_evidence) return std::nullopt;
  return tracked;
}

}  // namespace curvix
