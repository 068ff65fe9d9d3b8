// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 and 4. Deviation: every view is H1 once, with its best
// partners, for the edges that nothing explains yet; see docs/paper_map.md.
#include "edge_sketch/sketch_by_views.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "base/angles.h"
#include "base/parallel.h"
#include "edge_sketch/exclusive_support.h"
#include "edge_sketch/hypothesise.h"
#include "edge_sketch/select_views.h"
#include "edge_sketch/track_support.h"
#include "edge_sketch/view_index.h"
#include "geometry/epipolar.h"

namespace curvix {
namespace {

// Views within this angle see the same edges, unless something hides them.
constexpr double kSameSideRad = DegToRad(40);
// Factor of the least log-likelihood ratio.
constexpr double kSettledEvidence = 3;

// The results of one H1 edge.
struct H1Result {
  std::vector<TrackedEdge> tracked;
  std::vector<EdgeRef> also_shown;  // by views that were not queried
  std::int64_t hypotheses = 0;
  std::int64_t unsupported = 0;
  std::int64_t rivals = 0;
};

// A partner of an H1 view, and the query views of their hypotheses.
struct Partner {
  HypothesisViews pair;
  ViewsToAsk to_ask;
};

// All partners of an H1 view.
struct H1View {
  std::vector<Partner> partners;
  NeighborsByView neighbors;  // among query views
  // Those that overlap it or are of its station, ascending. Some of them are
  // not queried, or not for all edges.
  std::vector<std::int32_t> views_of_place;
};

// The stations of view h1 and of those that look from nearly the same
// direction.
std::size_t NumOnThisSide(const SketchInput& input, int h1) {
  const std::vector<int>& stations = input.distinct.stations;
  const auto i = static_cast<std::size_t>(h1);
  std::set<int> on_this_side = {stations[i]};
  for (const ViewOverlap& overlap : input.distinct.overlaps[i]) {
    if (overlap.ray_angle_rad <= kSameSideRad) {
      on_this_side.insert(stations[static_cast<std::size_t>(overlap.other)]);
    }
  }
  return on_this_side.size();
}

// The views next to either in direction, then both.
std::vector<std::int32_t> FirstViews(int h1,
                                     int h2,
                                     const NeighborsByView& neighbors,
                                     const DistinctViews& distinct) {
  std::vector<std::int32_t> first;
  for (const int view_idx : {h1, h2}) {
    const auto& before =
        distinct.before_at_station[static_cast<std::size_t>(view_idx)];
    first.insert(first.end(), before.begin(), before.end());
    for (const ViewNeighbor& neighbor :
         neighbors[static_cast<std::size_t>(view_idx)]) {
      first.push_back(neighbor.view_idx);
    }
  }
  std::erase_if(first, [&](int i) { return i == h1 || i == h2; });
  std::ranges::sort(first);
  first.erase(std::unique(first.begin(), first.end()), first.end());
  first.insert(first.end(), {h1, h2});
  return first;
}

// The views that overlap a view, and the others of its station, ascending.
std::vector<std::int32_t> ViewsOfSamePlaces(const DistinctViews& distinct,
                                            std::size_t view_idx) {
  std::vector<std::int32_t> views;
  for (const ViewOverlap& overlap : distinct.overlaps[view_idx]) {
    views.push_back(overlap.other);
  }
  for (std::size_t i = 0; i < distinct.stations.size(); ++i) {
    if (i != view_idx && distinct.stations[i] == distinct.stations[view_idx]) {
      views.push_back(static_cast<std::int32_t>(i));
    }
  }
  std::ranges::sort(views);
  views.erase(std::unique(views.begin(), views.end()), views.end());
  return views;
}

// View h1 and its partners, ready for pairing.
H1View Prepare(const SketchInput& input, int h1) {
  H1View view;
  const auto i = static_cast<std::size_t>(h1);
  const std::vector<int> partners =
      SelectPartners(input.distinct.overlaps[i], input.options.hypotheses);
  const std::vector<int> validators =
      SelectValidators(input.distinct, h1, partners);
  view.views_of_place = ViewsOfSamePlaces(input.distinct, i);
  view.neighbors =
      NeighborsInDirection(OverlapsAmong(input.distinct.overlaps, validators),
                           input.distinct.stations);
  const std::size_t fewest_supports =
      FewestSupports(input.options.validation, NumOnThisSide(input, h1));
  std::vector<std::optional<HypothesisViews>> pairs(partners.size());
  ParallelFor(
      pairs.size(), input.options.runtime.num_threads, [&](std::size_t k) {
        const auto j = static_cast<std::size_t>(partners[k]);
        const auto pencil =
            EpipolarPencil::Make(input.views[i], input.views[j]);
        if (!pencil) return;
        pairs[k].emplace(
            *pencil,
            input.views[i],
            input.views[j],
            input.edge_maps[j].edges,
            input.depths[i],
            input.options,
            input.finds_seeds ? &input.indices[j].appearance : nullptr);
      });
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (!pairs[k]) continue;
    view.partners.push_back(
        {*std::move(pairs[k]),
         {FirstViews(h1, partners[k], view.neighbors, input.distinct),
          validators,
          fewest_supports,
          input.finds_seeds}});
  }
  return view;
}

std::optional<TrackedEdge> Track(const SketchInput& input,
                                 const Hypothesis& hypothesis,
                                 const Partner& partner,
                                 const NeighborsByView& neighbors) {
  if (!MayBeSupported(hypothesis.edge, input.indices, partner.to_ask)) {
    return std::nullopt;
  }
  const EdgeEstimate start =
      EstimateAtMeeting(hypothesis.edge,
                        MeasurePlane(partner.pair.h1(), hypothesis.edge1),
                        MeasurePlane(partner.pair.h2(), hypothesis.edge2.edge),
                        input.sigma_px);
  return TrackSupport(start,
                      input.indices,
                      neighbors,
                      partner.to_ask,
                      input.sigma_px,
                      input.options.validation);
}

// Hypotheses from several partners end at the same 3D edge.
bool IsKnown(const TrackedEdge& edge, const std::vector<TrackedEdge>& known) {
  return std::ranges::any_of(known, [&](const TrackedEdge& other) {
    std::vector<EdgeRef> shared;
    std::set_intersection(edge.support.begin(),
                          edge.support.end(),
                          other.support.begin(),
                          other.support.end(),
                          std::back_inserter(shared));
    return 2 * shared.size() >= edge.support.size();
  });
}

// All views were queried for the tracked edges already, so another partner
// would lead to the same 3D edge.
bool IsSettled(const H1Result& result, const ValidationOptions& options) {
  return std::ranges::any_of(result.tracked, [&](const TrackedEdge& edge) {
    return edge.evidence >= kSettledEvidence * options.min_log_likelihood_ratio;
  });
}

void DropRivals(H1Result& result) {
  double best = 0;
  for (const TrackedEdge& edge : result.tracked) {
    best = std::max(best, edge.evidence);
  }
  const double least = kMinRelativeSupport * best;
  result.rivals += static_cast<std::int64_t>(std::erase_if(
      result.tracked,
      [&](const TrackedEdge& edge) { return edge.evidence < least; }));
}

// What an edge of an H1 view leads to.
H1Result Sketch(const SketchInput& input,
                const Edge2d& edge1,
                const H1View& view) {
  H1Result result;
  for (const Partner& partner : view.partners) {
    if (IsSettled(result, input.options.validation)) break;
    const Hypotheses found = partner.pair.Hypothesise(edge1);
    for (const Hypothesis& hypothesis : found.hypotheses) {
      ++result.hypotheses;
      auto tracked = Track(input, hypothesis, partner, view.neighbors);
      if (!tracked) {
        ++result.unsupported;
      } else if (!IsKnown(*tracked, result.tracked)) {
        result.tracked.push_back(*std::move(tracked));
      }
    }
  }
  DropRivals(result);
  for (const TrackedEdge& tracked : result.tracked) {
    const std::vector<EdgeRef> more =
        FindMoreSupport(tracked,
                        input.indices,
                        view.views_of_place,
                        view.partners.front().to_ask,
                        input.sigma_px,
                        input.options.validation);
    result.also_shown.insert(result.also_shown.end(), more.begin(), more.end());
  }
  return result;
}

Edge3d ToEdge3d(TrackedEdge tracked) {
  Edge3d edge;
  edge.position = tracked.estimate.edge.position;
  edge.tangent = tracked.estimate.edge.tangent;
  edge.sigma = std::sqrt(tracked.estimate.covariance.trace() / 2);
  edge.evidence = tracked.evidence;
  edge.support = std::move(tracked.support);
  return edge;
}

// In an order that does not depend on that of views.
bool IsBefore(const EdgeMap& a, const EdgeMap& b) {
  const auto place = [](const Edge2d& edge) {
    return std::pair(edge.position.y(), edge.position.x());
  };
  return std::ranges::lexicographical_compare(
      a.edges, b.edges, {}, place, place);
}

// The view with most unused edges among those not done; ties: that with more
// edges in all, then that whose edges come first. So the order of views makes
// no difference: many views may have as many edges as they are allowed.
std::optional<int> NextView(const SketchInput& input,
                            const std::vector<int>& num_unused,
                            const std::vector<bool>& done) {
  std::optional<std::size_t> best;
  const auto rank = [&](std::size_t i) {
    return std::pair(num_unused[i], input.edge_maps[i].edges.size());
  };
  const auto is_better = [&](std::size_t i) {
    if (rank(i) != rank(*best)) return rank(i) > rank(*best);
    return IsBefore(input.edge_maps[i], input.edge_maps[*best]);
  };
  for (std::size_t i = 0; i < done.size(); ++i) {
    if (!done[i] && (!best || is_better(i))) best = i;
  }
  if (!best) return std::nullopt;
  return static_cast<int>(*best);
}

// What the unused edges of view h1 that ask lead to, in their order: some along
// each contour, then, unless images are crowded, those next to one that led to
// a 3D edge.
std::vector<H1Result> QueryInTurns(const SketchInput& input,
                                   int h1,
                                   const H1View& view,
                                   const UsedEdges& used) {
  const EdgeMap& map = input.edge_maps[static_cast<std::size_t>(h1)];
  std::vector<std::optional<H1Result>> results(map.edges.size());
  const auto ask = [&](const std::vector<std::int32_t>& edge_idxs) {
    ParallelFor(edge_idxs.size(),
                input.options.runtime.num_threads,
                [&](std::size_t k) {
                  const auto i = static_cast<std::size_t>(edge_idxs[k]);
                  results[i] = Sketch(input, map.edges[i], view);
                });
  };
  const auto has_found = [&](const std::optional<std::int32_t>& edge_idx) {
    if (!edge_idx) return false;
    const auto& result = results[static_cast<std::size_t>(*edge_idx)];
    return result && !result->tracked.empty();
  };
  TwoTurns turns = SplitAlongContours(
      QueryEdges(input, h1, used), map.neighbors, LinksBetweenQueries(input));
  ask(turns.first);
  if (AreCrowded(input.edge_maps)) turns.second.clear();
  std::erase_if(turns.second, [&](std::int32_t edge_idx) {
    const EdgeNeighbors& neighbors =
        map.neighbors[static_cast<std::size_t>(edge_idx)];
    return !has_found(neighbors.previous) && !has_found(neighbors.next);
  });
  ask(turns.second);
  std::vector<H1Result> asked;
  for (std::optional<H1Result>& result : results) {
    if (result) asked.push_back(*std::move(result));
  }
  return asked;
}

void Add(H1Result result,
         const SketchInput& input,
         UsedEdges& used,
         EdgeSketch& sketch) {
  const std::vector<EdgeMap>& edge_maps = input.edge_maps;
  // As far as the next edges that ask: a 3D edge takes one 2D edge per view,
  // although contours are sampled at different steps.
  const int num_links = LinksBetweenQueries(input) - 1;
  ++sketch.counts.h1_edges;
  sketch.counts.hypotheses += result.hypotheses;
  sketch.counts.unsupported += result.unsupported;
  sketch.counts.rivals += result.rivals;
  MarkAlongContours(result.also_shown, edge_maps, num_links, used);
  for (TrackedEdge& tracked : result.tracked) {
    MarkAlongContours(tracked.support, edge_maps, num_links, used);
    sketch.edges.push_back(ToEdge3d(std::move(tracked)));
  }
}

}  // namespace

EdgeSketch TrackByViews(const SketchInput& input, const StepDone& step_done) {
  UsedEdges used(input.edge_maps);
  EdgeSketch sketch;
  sketch.edge_sigma_px = input.sigma_px;
  std::vector<bool> done = input.distinct.are_repeated;
  const auto total = static_cast<int>(std::ranges::count(done, false));
  for (int step = 0; step_done(step, total); ++step) {
    const auto h1 = NextView(input, used.num_unused(), done);
    if (!h1) break;
    done[static_cast<std::size_t>(*h1)] = true;
    const H1View view = Prepare(input, *h1);
    sketch.counts.view_pairs += static_cast<std::int64_t>(view.partners.size());
    for (H1Result& result : QueryInTurns(input, *h1, view, used)) {
      Add(std::move(result), input, used, sketch);
    }
  }
  sketch.counts.used_edges = used.total();
  return sketch;
}

void DropExplained(const std::vector<PosedView>& views,
                   const std::vector<EdgeMap>& edge_maps,
                   const ValidationOptions& options,
                   EdgeSketch& sketch) {
  const std::size_t num_confirmed = sketch.edges.size();
  sketch.edges = DropWithoutExclusiveSupport(std::move(sketch.edges),
                                             views,
                                             edge_maps,
                                             options.min_num_exclusive_views);
  sketch.counts.rivals +=
      static_cast<std::int64_t>(num_confirmed - sketch.edges.size());
}

EdgeSketch SketchByViews(const SketchInput& input, const StepDone& step_done) {
  EdgeSketch sketch = TrackByViews(input, step_done);
  DropExplained(input.views, input.edge_maps, input.options.validation, sketch);
  return sketch;
}

}  // namespace curvix
