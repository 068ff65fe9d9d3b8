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
// The hypothesis views and two more.
constexpr std::size_t kFewestSupports = 4;
constexpr double kGateSigmas = 4;
constexpr double kMaxTangentialPx = 1;

struct Search {
  double sigma_px = 0;
  double max_distance_px = 0;
  double min_cosine = 0;
};

// What a view shows there.
struct Answer {
  std::int32_t view_idx = 0;
  ImageEdge projected;
  double expected_px = 0;  // standard deviation of the distance from an edge
  std::optional<std::int32_t> edge_idx;
};

// nullopt if the edge is not in the image or not known well enough there.
std::optional<Answer> Ask(const EdgeEstimate& estimate,
                          const std::vector<ViewIndex>& views,
                          std::int32_t view_idx,
                          const Search& search) {
  const ViewIndex& view = views[static_cast<std::size_t>(view_idx)];
  const auto projected = ProjectEstimate(*view.view, estimate);
  const double limit_px =
      std::max(kMaxPredictedSigmaPx, kMaxPredictedSigmas * search.sigma_px);
  if (!projected || projected->variance_px2 > limit_px * limit_px) {
    return std::nullopt;
  }
  const double expected_px =
      std::sqrt(projected->variance_px2 + search.sigma_px * search.sigma_px);
  const Gate gate{std::min(search.max_distance_px, kGateSigmas * expected_px),
                  kMaxTangentialPx,
                  search.min_cosine};
  Answer answer{view_idx, projected->edge, expected_px, std::nullopt};
  if (view.presence.MayHave(projected->edge.position,
                            projected->edge.tangent)) {
    answer.edge_idx = NearestEdge(view, projected->edge, gate);
  }
  return answer;
}

// Whether `supports` is true of at least kFewestSupports of the views. Asks no
// more of them than it takes to know.
template <typename F>
bool AtLeastFewest(const std::vector<std::int32_t>& asked, const F& supports) {
  std::size_t num_supports = 0;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (num_supports + (asked.size() - i) < kFewestSupports) return false;
    if (supports(asked[i]) && ++num_supports == kFewestSupports) return true;
  }
  return false;
}

// By view index.
std::vector<Answer> AskAll(const EdgeEstimate& estimate,
                           const std::vector<ViewIndex>& views,
                           const std::vector<std::int32_t>& asked,
                           const Search& search) {
  std::vector<Answer> answers;
  answers.reserve(asked.size());
  for (const std::int32_t view_idx : asked) {
    if (auto answer = Ask(estimate, views, view_idx, search)) {
      answers.push_back(*answer);
    }
  }
  std::sort(
      answers.begin(), answers.end(), [](const Answer& a, const Answer& b) {
        return a.view_idx < b.view_idx;
      });
  return answers;
}

std::vector<EdgeRef> SupportIn(const std::vector<Answer>& answers) {
  std::vector<EdgeRef> support;
  for (const Answer& answer : answers) {
    if (answer.edge_idx) support.push_back({answer.view_idx, *answer.edge_idx});
  }
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

double VoteOf(const Answer& answer, const std::vector<ViewIndex>& views) {
  if (!answer.edge_idx) return VoteWithoutSupport();
  const ImageEdge edge = EdgeOf({answer.view_idx, *answer.edge_idx}, views);
  const ImageEdge& projected = answer.projected;
  const Eigen::Vector2d normal(-edge.tangent.y(), edge.tangent.x());
  const double angle = AngleOf(projected.tangent);
  const SupportFit fit{normal.dot(projected.position - edge.position),
                       answer.expected_px,
                       UndirectedDifference(angle, AngleOf(edge.tangent))};
  return VoteWithSupport(
      fit,
      views[static_cast<std::size_t>(answer.view_idx)].density.Density(
          projected.position, angle));
}

Votes VotesOf(const std::vector<Answer>& answers,
              const std::vector<ViewIndex>& views) {
  Votes votes(views.size());
  for (const Answer& answer : answers) {
    votes[static_cast<std::size_t>(answer.view_idx)] = VoteOf(answer, views);
  }
  return votes;
}

}  // namespace

double SearchReachPx(const ValidationOptions& options) {
  return std::hypot(options.max_distance_px, kMaxTangentialPx);
}

std::size_t FewestSupports(const ValidationOptions& options,
                           std::size_t num_on_this_side) {
  return std::min(static_cast<std::size_t>(options.min_num_support_views) + 2,
                  std::max(kFewestSupports, num_on_this_side / 2 + 1));
}

bool MayBeSupported(const SpaceEdge& edge,
                    const std::vector<ViewIndex>& views,
                    const ViewsToAsk& to_ask) {
  return AtLeastFewest(to_ask.first, [&](std::int32_t view_idx) {
    const ViewIndex& view = views[static_cast<std::size_t>(view_idx)];
    const auto projected = ProjectEdge(*view.view, edge);
    return projected &&
           view.presence.MayHave(projected->position, projected->tangent);
  });
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
  const bool is_worth_it =
      AtLeastFewest(to_ask.first, [&](std::int32_t view_idx) {
        const auto answer = Ask(start, views, view_idx, search);
        return answer && answer->edge_idx;
      });
  if (!is_worth_it) return std::nullopt;
  TrackedEdge tracked;
  tracked.estimate = start;
  std::vector<Answer> answers;
  for (int round = 0; round < kNumRounds; ++round) {
    answers = AskAll(tracked.estimate,
                     views,
                     round == 0 ? to_ask.first : to_ask.all,
                     search);
    std::vector<EdgeRef> support = SupportIn(answers);
    if (support.size() < kFewestSupports) return std::nullopt;
    // Settled: further rounds would ask the same views.
    if (round > 0 && tracked.support == support) break;
    tracked.estimate =
        AdjustEdge(tracked.estimate.edge, Measure(support, views), sigma_px);
    tracked.support = std::move(support);
  }
  if (tracked.support.size() <
      FewestSupports(options, to_ask.num_on_this_side)) {
    return std::nullopt;
  }
  tracked.evidence = Evidence(VotesOf(answers, views), neighbors);
  if (tracked.evidence < options.min_evidence) return std::nullopt;
  return tracked;
}

}  // namespace curvix
