// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(c).
#include "validation/track_support.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/angles.h"
#include "geometry/image_edge.h"

namespace curvix {
namespace {

constexpr int kNumRounds = 4;
// Views in which the estimate may be off by more are not asked yet. Pixels.
constexpr double kMaxPredictedSigmaPx = 0.7;
// The hypothesis views and two more.
constexpr int kFewestSupports = 4;
constexpr double kGateSigmas = 4;
constexpr double kMaxTangentialPx = 1;

struct Support {
  std::vector<EdgeRef> refs;
  std::vector<PlaneMeasurement> measurements;
  Votes votes;
};

double AngleOf(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

SupportFit Fit(const ImageEdge& projected,
               const ImageEdge& edge,
               double sigma_px) {
  const Eigen::Vector2d normal(-edge.tangent.y(), edge.tangent.x());
  return {
      normal.dot(projected.position - edge.position),
      sigma_px,
      UndirectedDifference(AngleOf(projected.tangent), AngleOf(edge.tangent))};
}

// What one view says; nothing if the edge is not in its image or not known well
// enough there.
void AskView(const EdgeEstimate& estimate,
             const ViewIndex& view,
             std::int32_t view_idx,
             double sigma_px,
             const ValidationOptions& options,
             Support& support) {
  const auto projected = ProjectEdge(*view.view, estimate.edge);
  if (!projected || !view.view->Contains(projected->position)) return;
  const Eigen::Vector2d gradient =
      DistanceGradient(estimate, *view.view, *projected);
  const double predicted =
      std::sqrt(gradient.dot(estimate.covariance * gradient));
  if (predicted > kMaxPredictedSigmaPx) return;
  const double expected = std::hypot(predicted, sigma_px);
  const Gate gate{std::min(options.max_distance_px, kGateSigmas * expected),
                  kMaxTangentialPx,
                  std::cos(DegToRad(options.max_angle_deg))};
  std::optional<double>& vote =
      support.votes[static_cast<std::size_t>(view_idx)];
  const auto nearest = NearestEdge(view, *projected, gate);
  if (!nearest) {
    vote = VoteWithoutSupport();
    return;
  }
  const ImageEdge edge =
      ToImageEdge(view.edges->edges[static_cast<std::size_t>(*nearest)]);
  vote = VoteWithSupport(
      Fit(*projected, edge, expected),
      view.density.Density(projected->position, AngleOf(projected->tangent)));
  support.refs.push_back({view_idx, *nearest});
  support.measurements.push_back(MeasurePlane(*view.view, edge));
}

Support FindSupport(const EdgeEstimate& estimate,
                    const std::vector<ViewIndex>& views,
                    const std::vector<std::int32_t>& asked,
                    double sigma_px,
                    const ValidationOptions& options) {
  Support support;
  support.votes.resize(views.size());
  for (const std::int32_t view_idx : asked) {
    AskView(estimate,
            views[static_cast<std::size_t>(view_idx)],
            view_idx,
            sigma_px,
            options,
            support);
  }
  return support;
}

std::vector<std::int32_t> AllOf(const std::vector<ViewIndex>& views) {
  std::vector<std::int32_t> all(views.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

std::optional<TrackedEdge> TrackSupport(
    const EdgeEstimate& start,
    const std::vector<ViewIndex>& views,
    const std::vector<std::vector<ViewNeighbor>>& neighbors,
    const std::vector<std::int32_t>& first_views,
    double sigma_px,
    const ValidationOptions& options) {
  TrackedEdge tracked;
  tracked.estimate = start;
  Support support;
  for (int round = 0; round < kNumRounds; ++round) {
    support = FindSupport(tracked.estimate,
                          views,
                          round == 0 ? first_views : AllOf(views),
                          sigma_px,
                          options);
    if (static_cast<int>(support.refs.size()) < kFewestSupports) {
      return std::nullopt;
    }
    // Settled: further rounds would ask the same views.
    if (round > 0 && tracked.support == support.refs) break;
    tracked.estimate =
        AdjustEdge(tracked.estimate.edge, support.measurements, sigma_px);
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
