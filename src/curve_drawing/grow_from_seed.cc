// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). One curve, from its seed on.
#include "curve_drawing/grow_curves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <tuple>

#include <unordered_set>
#include <utility>

#include "curve_drawing/curve_tip.h"
#include "edge_sketch/visible_side.h"
#include "geometry/adjust_edge.h"
#include "geometry/edge_geometry.h"
#include "geometry/nearest_edge.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

// Steps are a pixel long in the view that sees them largest, but no longer than
// so many where all see them foreshortened.
constexpr double kStepPx = 1;
constexpr double kMaxForeshortening = 4;
// Views in which the prediction is less certain are not queried.
constexpr double kMaxPredictedSigmaPx = 0.7;
// Least log-likelihood ratio (evidence.h) of a supported sample, as a share of
// the mean of its curve, 0..1.
constexpr double kMinRelativeEvidence = 0.3;
// Least AppearanceRatio() of a hit that supports a curve; others only vote.
constexpr double kMinAppearanceRatio = 0.5;
// Longest gap without supported samples: pixels, as steps are.
constexpr double kMaxUnsupportedPx = 10;
// Number of samples that the log-likelihood ratio of the seed counts as.
constexpr double kSeedWeight = 5;
constexpr std::size_t kMinNumSamples = 5;
// Fewest views that support a sample.
constexpr std::size_t kMinNumSupports = 3;
// Curves that come back to their seed so near are closed, if they are so long.
constexpr double kCloseSteps = 2;
constexpr double kCloseCosine = 0.9;
constexpr std::size_t kMinClosedSteps = 32;
// The last steps do not claim their edges yet, so that these are still there
// for the next ones and for the other direction.
constexpr std::size_t kUnclaimedSteps = 32;

struct GrownSample : CurveSample {
  std::int64_t num_looks = 0;  // queries
};

void SetEdge(const SpaceEdge& edge, CurveSample& sample) {
  sample.position = edge.position;
  sample.tangent = edge.tangent;
}

void DropHit(CurveSample& sample, std::size_t view_idx) {
  std::erase_if(sample.support, [&](const EdgeRef& hit) {
    return static_cast<std::size_t>(hit.view_idx) == view_idx;
  });
}

// Leaves out the hits of a view in fewer than three samples; one miss in
// between does not end a streak.
void DropShortStreaks(std::size_t num_views, std::vector<GrownSample>& path) {
  std::vector<std::vector<std::size_t>> hit_samples(num_views);
  for (std::size_t k = 0; k < path.size(); ++k) {
    for (const EdgeRef& hit : path[k].support) {
      hit_samples[static_cast<std::size_t>(hit.view_idx)].push_back(k);
    }
  }
  for (std::size_t v = 0; v < hit_samples.size(); ++v) {
    const std::vector<std::size_t>& samples = hit_samples[v];
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= samples.size(); ++i) {
      if (i < samples.size() && samples[i] <= samples[i - 1] + 2) continue;
      if (i - begin < static_cast<std::size_t>(Streaks::kLength)) {
        for (std::size_t j = begin; j < i; ++j) DropHit(path[samples[j]], v);
      }
      begin = i;
    }
  }
}

// Trims both ends to samples with kMinNumSupports supports.
void TrimEnds(std::vector<GrownSample>& path) {
  const auto is_shown = [](const CurveSample& sample) {
    return sample.support.size() >= kMinNumSupports;
  };
  path.erase(std::find_if(path.rbegin(), path.rend(), is_shown).base(),
             path.end());
  path.erase(path.begin(), std::ranges::find_if(path, is_shown));
}

// The result of a query in one view.
struct Look {
  std::optional<EdgeRef> hit;
  Vote vote;
};
using Looks = std::vector<std::optional<Look>>;  // by view; none: no query

Votes VotesOf(const Looks& looks) {
  Votes votes;
  votes.reserve(looks.size());
  for (const auto& look : looks) {
    votes.push_back(look ? std::optional(look->vote) : std::nullopt);
  }
  return votes;
}

// The edges that a growing curve has already.
class OwnEdges {
 public:
  bool Contains(const EdgeRef& ref) const { return keys_.contains(Key(ref)); }
  void Add(const std::vector<EdgeRef>& refs) {
    for (const EdgeRef& ref : refs) keys_.insert(Key(ref));
  }

 private:
  static std::int64_t Key(const EdgeRef& ref) {
    return (std::int64_t{ref.view_idx} << 32) | ref.edge_idx;
  }
  std::unordered_set<std::int64_t> keys_;
};

class Grower {
 public:
  Grower(const GrowthInput& input, const UsedEdges& claimed)
      : input_(input),
        claimed_(claimed),
        widest_(WidestGate(input.validation)) {}

  Growth Grow(const Edge3d& seed) {
    std::vector<EdgeRef> support = seed.support;
    std::erase_if(support,
                  [&](const EdgeRef& ref) { return claimed_.Contains(ref); });
    const double pixel = PixelSize(seed.position, support, input_.views);
    if (support.size() < kMinNumSupports ||
        2 * support.size() < seed.support.size() || !(pixel > 0)) {
      return {};
    }
    found_ = support;
    const CurveTip tip({seed.position, seed.tangent},
                       MeasureAll(support),
                       input_.edge_sigma_px,
                       pixel);
    facing_ = ChooseSide(tip, support);
    GrownSample first;
    SetEdge(tip.edge(), first);
    first.sigma = tip.Sigma();
    first.evidence = seed.evidence;
    first.support = support;
    first.num_looks = static_cast<std::int64_t>(support.size());
    GrownCurve grown;
    std::vector<GrownSample> path =
        GrowBothWays(tip, first, &grown.curve.closed);
    DropShortStreaks(input_.indices.size(), path);
    if (!grown.curve.closed) TrimEnds(path);
    if (path.size() < kMinNumSamples) return {std::nullopt, std::move(found_)};
    for (GrownSample& sample : path) {
      grown.num_looks += sample.num_looks;
      grown.curve.samples.push_back(std::move(sample));
    }
    return {std::move(grown), std::move(found_)};
  }

 private:
  std::vector<PlaneMeasurement> MeasureAll(
      const std::vector<EdgeRef>& refs) const {
    std::vector<PlaneMeasurement> measurements =
        MeasurePlanes(refs, input_.indices);
    // Sums must not depend on the order of views.
    std::ranges::sort(measurements, {}, [](const PlaneMeasurement& m) {
      return std::tuple(m.plane.x(), m.plane.y(), m.plane.z());
    });
    return measurements;
  }

  // nullopt if the view is not queried or the prediction is too uncertain.
  std::optional<Look> LookIn(std::size_t v,
                             const CurveTip& tip,
                             double pixel_size) const {
    const ViewIndex& index = input_.indices[v];
    const auto view_idx = static_cast<std::int32_t>(v);
    const auto projected =
        ProjectIntoQueryView(view_idx, tip.edge(), pixel_size, input_.indices);
    if (!projected) return std::nullopt;
    const double variance_px2 = tip.VarianceIn(*index.view, *projected);
    if (variance_px2 > kMaxPredictedSigmaPx * kMaxPredictedSigmaPx) {
      return std::nullopt;
    }
    const double expected_px =
        std::sqrt(variance_px2 + input_.edge_sigma_px * input_.edge_sigma_px);
    const auto nearest =
        NearestEdge(index.grid,
                    *projected,
                    NarrowGate(widest_, expected_px),
                    [&](std::int32_t i) {
                      return !claimed_.Contains({view_idx, i}) &&
                             !own_.Contains({view_idx, i});
                    });
    if (!nearest) return Look{std::nullopt, VoteWithoutSupport()};
    const EdgeRef hit{view_idx, *nearest};
    return Look{
        hit,
        VoteWithSupport(
            index, *projected, expected_px, EdgeOf(hit, input_.indices))};
  }

  // A step that is a pixel long in the view of `support` that sees it largest,
  // in pixels of the tip, which are those at the seed.
  double StepAlong(const CurveTip& tip,
                   const std::vector<EdgeRef>& support) const {
    const double across =
        PixelSize(tip.edge().position, support, input_.views) / tip.pixel();
    if (!(across > 0)) return kStepPx;
    const double along =
        PixelSizeAlong(tip.edge(), support, input_.views) / tip.pixel();
    return kStepPx * std::clamp(along, across, kMaxForeshortening * across);
  }

  // What each view shows at the tip.
  Looks LookInAll(const CurveTip& tip, const std::vector<EdgeRef>& support) {
    const double pixel_size =
        TypicalPixelSize(tip.edge().position, support, input_.indices);
    Looks looks(input_.indices.size());
    for (std::size_t v = 0; v < looks.size(); ++v) {
      looks[v] = LookIn(v, tip, pixel_size);
      if (looks[v] && looks[v]->hit) found_.push_back(*looks[v]->hit);
    }
    return looks;
  }

  // The side from which the curve is seen, by the votes at its seed.
  std::optional<Eigen::Vector3d> ChooseSide(
      const CurveTip& tip, const std::vector<EdgeRef>& support) {
    return FindVisibleSide(tip.edge(),
                           VotesOf(LookInAll(tip, support)),
                           input_.neighbors,
                           input_.indices)
        .facing;
  }

  // The sample at the tip, and what supports it. `trusted` are the hits of
  // views that support the curve steadily: on entry those of the step before.
  GrownSample LookAround(const CurveTip& tip,
                         Streaks& streaks,
                         std::vector<EdgeRef>& trusted) {
    GrownSample grown;
    const Looks looks = LookInAll(tip, trusted);
    const Votes votes = VotesOf(looks);
    Votes in_front = votes;
    trusted.clear();
    for (std::size_t v = 0; v < looks.size(); ++v) {
      if (!looks[v]) continue;
      const auto& [hit, vote] = *looks[v];
      if (IsInFront(input_.views[v].center, tip.edge(), facing_)) {
        ++grown.num_looks;
      } else {
        in_front[v].reset();
      }
      const bool is_hit =
          hit && AppearanceRatio(vote, votes, input_.neighbors[v]) >=
                     kMinAppearanceRatio;
      if (is_hit) grown.support.push_back(*hit);
      if (streaks.Count(v, is_hit)) trusted.push_back(*hit);
    }
    // Rounded, so that the order of views makes no difference.
    grown.evidence =
        std::round(1e6 * Evidence(in_front, input_.neighbors)) / 1e6;
    return grown;
  }

  // Moves the tip a step on and corrects it by the hits of views that support
  // the curve steadily. `trusted` are these hits: on entry those of the step
  // before, which set the length of the step, afterwards those of this one.
  GrownSample StepOn(CurveTip& tip,
                     Streaks& streaks,
                     std::vector<EdgeRef>& trusted) {
    tip.Step(StepAlong(tip, trusted));
    GrownSample grown = LookAround(tip, streaks, trusted);
    tip.Correct(MeasureAll(trusted));
    SetEdge(tip.edge(), grown);
    grown.sigma = SigmaOf(tip, grown.support);
    return grown;
  }

  // The sigma of a 3D edge with this support, as the selection of curves
  // expects; the tip has a smaller one.
  double SigmaOf(const CurveTip& tip,
                 const std::vector<EdgeRef>& support) const {
    if (support.size() < 2) return tip.Sigma();
    const EdgeEstimate estimate =
        AdjustEdge(tip.edge(), MeasureAll(support), input_.edge_sigma_px);
    return std::sqrt(estimate.covariance.trace() / 2);
  }

  // The samples ahead of `first`, without it.
  std::vector<GrownSample> Follow(CurveTip tip,
                                  const GrownSample& first,
                                  bool* closed) {
    Streaks streaks(input_.indices.size(), first.support);
    double sum_evidence = kSeedWeight * first.evidence;
    double num_evidence = kSeedWeight;
    std::vector<GrownSample> path;
    std::vector<EdgeRef> trusted = first.support;
    std::size_t num_shown = 0;  // up to the last one that is shown
    std::size_t num_claimed = 0;
    while (static_cast<double>(path.size() - num_shown) * kStepPx <=
           kMaxUnsupportedPx) {
      path.push_back(StepOn(tip, streaks, trusted));
      const double evidence = path.back().evidence;
      if (trusted.size() >= kMinNumSupports &&
          evidence * num_evidence >= kMinRelativeEvidence * sum_evidence) {
        sum_evidence += evidence;
        num_evidence += 1;
        num_shown = path.size();
      }
      while (num_claimed + kUnclaimedSteps < num_shown) {
        own_.Add(path[num_claimed++].support);
      }
      *closed = path.size() > kMinClosedSteps &&
                Meets(tip, first, StepAlong(tip, trusted));
      if (*closed) return path;
    }
    path.resize(num_shown);
    return path;
  }

  static bool Meets(const CurveTip& tip,
                    const GrownSample& first,
                    double step_px) {
    const Eigen::Vector3d offset = first.position - tip.edge().position;
    return offset.norm() < kCloseSteps * step_px * tip.pixel() &&
           tip.edge().tangent.dot(first.tangent) > kCloseCosine;
  }

  std::vector<GrownSample> GrowBothWays(const CurveTip& tip,
                                        const GrownSample& first,
                                        bool* closed) {
    std::vector<GrownSample> ahead = Follow(tip, first, closed);
    std::vector<GrownSample> path;
    if (!*closed) {
      path = GrowBack(tip, first, closed);
      if (*closed) ahead.clear();
    }
    path.push_back(first);
    std::ranges::move(ahead, std::back_inserter(path));
    return path;
  }

  // The samples behind `first`, in the order of those ahead.
  std::vector<GrownSample> GrowBack(CurveTip tip,
                                    GrownSample first,
                                    bool* closed) {
    tip.Reverse();
    SetEdge(tip.edge(), first);
    std::vector<GrownSample> path = Follow(tip, first, closed);
    std::ranges::reverse(path);
    for (GrownSample& grown : path) grown.tangent = -grown.tangent;
    return path;
  }

  const GrowthInput& input_;
  const UsedEdges& claimed_;
  const Gate widest_;
  OwnEdges own_;
  std::optional<Eigen::Vector3d> facing_;  // of the curve, see VisibleSide
  std::vector<EdgeRef> found_;
};

}  // namespace

Growth GrowFromSeed(const Edge3d& seed,
                    const GrowthInput& input,
                    const UsedEdges& claimed) {
  return Grower(input, claimed).Grow(seed);
}

}  // namespace curvix
