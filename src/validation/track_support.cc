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
// Views in which the estimate may be off by more are not asked yet: pixels, or
// standard deviations of an edge's location where these are larger.
constexpr double kMaxPredictedSigmaPx = 0.7;
constexpr double kMaxPredictedSigmas = 4.6;
// The hypothesis views and one more.
constexpr std::size_t kFewestSupports = 3;
// Of the first views: fewer are hardly ever followed by enough of all.
constexpr std::size_t kFewestToGoOn = 4;
constexpr double kGateSigmas = 4;

struct Search {
  double sigma_px = 0;
  double max_distance_px = 0;
  double min_cosine = 0;
};

// Where a view shows an estimate.
struct Prediction {
  ImageEdge projected;
  double expected_px = 0;  // standard deviation of the distance from an edge
};

// nullopt if the edge is not in the image or not known well enough there.
std::optional<Prediction> Predict(const EdgeEstimate& estimate,
                                  const ViewIndex& view,
                                  const Search& search) {
  const auto projected = ProjectEstimate(*view.view, estimate);
  const double limit_px =
      std::max(kMaxPredictedSigmaPx, kMaxPredictedSigmas * search.sigma_px);
  if (!projected || projected->variance_px2 > limit_px * limit_px) {
    return std::nullopt;
  }
  return Prediction{
      projected->edge,
      std::sqrt(projected->variance_px2 + search.sigma_px * search.sigma_px)};
}

// False only if FindEdge() would find nothing.
bool MayShow(const ViewIndex& view, const SpaceEdge& edge) {
  const Eigen::Vector3d x = view.view->InCamera(edge.position);
  if (!(x.z() > 0)) return false;
  const Eigen::Vector2d tangent = TangentInImage(*view.view, x, edge.tangent);
  if (!(tangent.squaredNorm() > 0)) return false;
  const Eigen::Vector2d pixel = view.view->Pixel(x);
  return view.view->Contains(pixel) && view.presence.MayHave(pixel, tangent);
}

std::optional<std::int32_t> FindEdge(const EdgeEstimate& estimate,
                                     const ViewIndex& view,
                                     const Search& search) {
  if (!MayShow(view, estimate.edge)) return std::nullopt;
  const auto predicted = Predict(estimate, view, search);
  if (!predicted) return std::nullopt;
  return NearestEdge(
      view,
      predicted->projected,
      {std::min(search.max_distance_px, kGateSigmas * predicted->expected_px),
       kMaxSupportSlidePx,
       search.min_cosine});
}

std::size_t FewestToGoOn(const ViewsToAsk& to_ask) {
  return std::min(kFewestToGoOn, to_ask.fewest_supports);
}

// The support of an estimate in the views of `asked`, ascending; nullopt if it
// is less than `fewest`. Asks no more of them than it takes to know.
std::optional<std::vector<EdgeRef>> FindSupport(
    const EdgeEstimate& estimate,
    const std::vector<ViewIndex>& views,
    const std::vector<std::int32_t>& asked,
    std::size_t fewest,
    const Search& search) {
  std::vector<EdgeRef> support;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (support.size() + (asked.size() - i) < fewest) break;
    const ViewIndex& view = views[static_cast<std::size_t>(asked[i])];
    if (const auto edge_idx = FindEdge(estimate, view, search)) {
      support.push_back({asked[i], *edge_idx});
    }
  }
  if (support.size() < fewest) return std::nullopt;
  std::sort(support.begin(), support.end());
  return support;
}

ImageEdge EdgeOf(const EdgeRef& ref, const std::vector<ViewIndex>& views) {
  return ToImageEdge(views[static_cast<std::size_t>(ref.view_idx)]
                         .edges->edges[static_cast<std::size_t>(ref.edge_idx)]);
}

std::vector<PlaneMeasurement> Measure(const std::vector<EdgeRef>& support,
                                      const std::vector<ViewIndex>& views) {
  std::vector<PlaneMeasurement> measurements;
  measurements.reserve(support.size());
  for (const EdgeRef& ref : support) {
    measurements.push_back(
        MeasurePlane(*views[static_cast<std::size_t>(ref.view_idx)].view,
                     EdgeOf(ref, views)));
  }
  return measurements;
}

double AngleOf(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

double VoteWithSupport(const Prediction& predicted,
                       const EdgeRef& support,
                       const std::vector<ViewIndex>& views) {
  const ImageEdge edge = EdgeOf(support, views);
  const ImageEdge& projected = predicted.projected;
  const Eigen::Vector2d normal(-edge.tangent.y(), edge.tangent.x());
  const double angle = AngleOf(projected.tangent);
  const SupportFit fit{normal.dot(projected.position - edge.position),
                       predicted.expected_px,
                       UndirectedDifference(angle, AngleOf(edge.tangent))};
  return VoteWithSupport(
      fit,
      views[static_cast<std::size_t>(support.view_idx)].density.Density(
          projected.position, angle));
}

// The votes of the views of `asked` (ascending) on an estimate with this
// support (FindSupport()).
Votes VotesOf(const EdgeEstimate& estimate,
              const std::vector<EdgeRef>& support,
              const std::vector<ViewIndex>& views,
              const std::vector<std::int32_t>& asked,
              const Search& search) {
  Votes votes(views.size());
  auto next = support.begin();
  for (const std::int32_t view_idx : asked) {
    const auto i = static_cast<std::size_t>(view_idx);
    const bool supports = next != support.end() && next->view_idx == view_idx;
    if (const auto predicted = Predict(estimate, views[i], search)) {
      votes[i] = supports ? VoteWithSupport(*predicted, *next, views)
                          : VoteWithoutSupport();
    }
    if (supports) ++next;
  }
  return votes;
}

}  // namespace

std::size_t FewestSupports(const ValidationOptions& options,
                           std::size_t num_on_this_side) {
  return std::min(static_cast<std::size_t>(options.min_num_support_views) + 2,
                  std::max(kFewestSupports, num_on_this_side / 2 + 1));
}

bool MayBeSupported(const SpaceEdge& edge,
                    const std::vector<ViewIndex>& views,
                    const ViewsToAsk& to_ask) {
  const std::vector<std::int32_t>& asked = to_ask.first;
  const std::size_t fewest = FewestToGoOn(to_ask);
  std::size_t num_found = 0;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (num_found + (asked.size() - i) < fewest) return false;
    const ViewIndex& view = views[static_cast<std::size_t>(asked[i])];
    if (MayShow(view, edge) && ++num_found == fewest) return true;
  }
  return false;
}

std::optional<TrackedEdge> TrackSupport(
    const EdgeEstimate& start,
    const std::vector<ViewIndex>& views,
    const std::vector<std::vector<ViewNeighbor>>& neighbors,
    const ViewsToAsk& to_ask,
    double sigma_px,
    const ValidationOptions& options) {
  const Search search{sigma_px,
                      options.max_distance_px,
                      std::cos(DegToRad(options.max_angle_deg))};
  auto support =
      FindSupport(start, views, to_ask.first, FewestToGoOn(to_ask), search);
  if (!support) return std::nullopt;
  TrackedEdge tracked;
  tracked.estimate = start;
  EdgeEstimate asked;  // that led to the support
  for (int round = 1;; ++round) {
    tracked.support = *std::move(support);
    asked = tracked.estimate;
    tracked.estimate = AdjustEdge(
        tracked.estimate.edge, Measure(tracked.support, views), sigma_px);
    if (round == kNumRounds) break;
    support = FindSupport(
        tracked.estimate, views, to_ask.all, to_ask.fewest_supports, search);
    if (!support) return std::nullopt;
    // Settled: further rounds would ask the same views.
    if (*support == tracked.support) {
      asked = tracked.estimate;
      break;
    }
  }
  tracked.evidence = Evidence(
      VotesOf(asked, tracked.support, views, to_ask.all, search), neighbors);
  if (tracked.evidence < options.min_evidence) return std::nullopt;
  return tracked;
}

}  // namespace curvix
