// SPDX-License-Identifier: BSD-3-Clause
#include "edge_sketch/track_support.h"

#include <algorithm>
#include <cmath>

#include "base/infinity.h"
#include "edge_sketch/visible_side.h"
#include "geometry/edge_geometry.h"
#include "geometry/nearest_edge.h"

namespace curvix {
namespace {

constexpr int kNumRounds = 4;
// Views in which the estimate may be off by more are not queried yet: pixels,
// or standard deviations of an edge's location where these are larger.
constexpr double kMaxPredictedSigmaPx = 0.7;
constexpr double kMaxPredictedSigmas = 4.6;
// The hypothesis views and one more.
constexpr std::size_t kFewestSupports = 3;
// Fewer supports in the first views are hardly ever followed by enough in all.
constexpr std::size_t kFewestToGoOn = 4;

struct Search {
  double sigma_px = 0;
  Gate widest;
  double pixel_size = kInfinity;  // see ProjectIntoQueryView()
};

// False only if no edge can be found for `edge`.
bool MayShow(const ViewIndex& view, const SpaceEdge& edge) {
  const Eigen::Vector3d x = view.view->InCamera(edge.position);
  if (!(x.z() > 0)) return false;
  const Eigen::Vector2d tangent = TangentInImage(*view.view, x, edge.tangent);
  if (!(tangent.squaredNorm() > 0)) return false;
  const Eigen::Vector2d pixel = view.view->Pixel(x);
  return view.view->Contains(pixel) && view.presence.MayHave(pixel, tangent);
}

// The standard deviation of the distance between the estimate, as `view` shows
// it, and its edge there; nullopt if the estimate is not known well enough.
std::optional<double> ExpectedDistance(const EdgeEstimate& estimate,
                                       const ImageEdge& projected,
                                       const ViewIndex& view,
                                       const Search& search) {
  const double variance_px2 = VarianceAcross(*view.view, projected, estimate);
  const double limit_px =
      std::max(kMaxPredictedSigmaPx, kMaxPredictedSigmas * search.sigma_px);
  if (variance_px2 > limit_px * limit_px) return std::nullopt;
  return std::sqrt(variance_px2 + search.sigma_px * search.sigma_px);
}

std::optional<std::int32_t> FindEdge(const EdgeEstimate& estimate,
                                     const ImageEdge& projected,
                                     const ViewIndex& view,
                                     const Search& search) {
  const auto expected_px = ExpectedDistance(estimate, projected, view, search);
  if (!expected_px) return std::nullopt;
  return NearestEdge(
      view.grid, projected, NarrowGate(search.widest, *expected_px));
}

std::size_t FewestToGoOn(const ViewsToAsk& to_ask) {
  return std::min(kFewestToGoOn, to_ask.fewest_supports);
}

// A view and where it shows an estimate.
struct Sighting {
  std::int32_t view_idx = 0;
  ImageEdge projected;
};

// The support of an estimate in the views of `asked`, ascending; nullopt if it
// is less than `fewest`. Stops as soon as this is known.
std::optional<std::vector<EdgeRef>> FindSupport(
    const EdgeEstimate& estimate,
    const std::vector<ViewIndex>& views,
    const std::vector<std::int32_t>& asked,
    std::size_t fewest,
    const Search& search) {
  // Most estimates end with this, before any edge is looked up.
  std::vector<Sighting> sightings;
  sightings.reserve(asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (sightings.size() + (asked.size() - i) < fewest) return std::nullopt;
    const ViewIndex& view = views[static_cast<std::size_t>(asked[i])];
    const auto projected =
        ProjectIntoQueryView(asked[i], estimate.edge, search.pixel_size, views);
    if (projected &&
        view.presence.MayHave(projected->position, projected->tangent)) {
      sightings.push_back({asked[i], *projected});
    }
  }
  std::vector<EdgeRef> support;
  support.reserve(sightings.size());
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (support.size() + (sightings.size() - i) < fewest) return std::nullopt;
    const auto& [view_idx, projected] = sightings[i];
    const ViewIndex& view = views[static_cast<std::size_t>(view_idx)];
    if (const auto edge_idx = FindEdge(estimate, projected, view, search)) {
      support.push_back({view_idx, *edge_idx});
    }
  }
  if (support.size() < fewest) return std::nullopt;
  std::sort(support.begin(), support.end());
  return support;
}

// The vote of a view with this support, if any; nullopt if it is not queried,
// or the estimate is too uncertain in it.
std::optional<Vote> VoteOf(std::int32_t view_idx,
                           const std::vector<ViewIndex>& views,
                           const std::optional<EdgeRef>& support,
                           const EdgeEstimate& estimate,
                           const Search& search) {
  const auto projected =
      ProjectIntoQueryView(view_idx, estimate.edge, search.pixel_size, views);
  if (!projected) return std::nullopt;
  const ViewIndex& view = views[static_cast<std::size_t>(view_idx)];
  const auto expected_px = ExpectedDistance(estimate, *projected, view, search);
  if (!expected_px) return std::nullopt;
  if (!support) return VoteWithoutSupport();
  return VoteWithSupport(
      view, *projected, *expected_px, EdgeOf(*support, views));
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
    std::optional<EdgeRef> supporting;
    if (next != support.end() && next->view_idx == view_idx) {
      supporting = *next++;
    }
    votes[static_cast<std::size_t>(view_idx)] =
        VoteOf(view_idx, views, supporting, estimate, search);
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

std::optional<TrackedEdge> TrackSupport(const EdgeEstimate& start,
                                        const std::vector<ViewIndex>& views,
                                        const NeighborsByView& neighbors,
                                        const ViewsToAsk& to_ask,
                                        double sigma_px,
                                        const ValidationOptions& options) {
  Search search{sigma_px, WidestGate(options)};
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
        tracked.estimate.edge, MeasurePlanes(tracked.support, views), sigma_px);
    if (round == kNumRounds) break;
    search.pixel_size = TypicalPixelSize(
        tracked.estimate.edge.position, tracked.support, views);
    support = FindSupport(
        tracked.estimate, views, to_ask.all, to_ask.fewest_supports, search);
    if (!support) return std::nullopt;
    // Settled: further rounds would ask the same views.
    if (*support == tracked.support) {
      asked = tracked.estimate;
      break;
    }
  }
  const Votes votes =
      VotesOf(asked, tracked.support, views, to_ask.all, search);
  tracked.evidence =
      to_ask.from_one_side
          ? FindVisibleSide(asked.edge, votes, neighbors, views).evidence
          : Evidence(votes, neighbors);
  if (tracked.evidence < options.min_log_likelihood_ratio) return std::nullopt;
  return tracked;
}

std::vector<EdgeRef> FindMoreSupport(
    const TrackedEdge& tracked,
    const std::vector<ViewIndex>& views,
    const std::vector<std::int32_t>& views_of_place,
    const ViewsToAsk& asked,
    double sigma_px,
    const ValidationOptions& options) {
  const EdgeEstimate& estimate = tracked.estimate;
  const double pixel_size =
      TypicalPixelSize(estimate.edge.position, tracked.support, views);
  const Search search{sigma_px, WidestGate(options)};
  std::vector<EdgeRef> support;
  for (const std::int32_t view_idx : views_of_place) {
    if (std::ranges::binary_search(asked.all, view_idx) &&
        ProjectIntoQueryView(view_idx, estimate.edge, pixel_size, views)) {
      continue;
    }
    const ViewIndex& view = views[static_cast<std::size_t>(view_idx)];
    const auto projected = ProjectInto(*view.view, estimate.edge);
    if (!projected ||
        !view.presence.MayHave(projected->position, projected->tangent)) {
      continue;
    }
    if (const auto edge_idx = FindEdge(estimate, *projected, view, search)) {
      support.push_back({view_idx, *edge_idx});
    }
  }
  return support;
}

}  // namespace curvix
