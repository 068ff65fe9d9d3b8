// SPDX-License-Identifier: BSD-3-Clause
#include "paper/sketch_by_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/angles.h"
#include "base/parallel.h"
#include "edge_sketch/hypothesise.h"
#include "edge_sketch/select_views.h"

namespace curvix {

WedgeSupport::WedgeSupport(const EpipolarPencil& pencil1,
                           const EpipolarPencil& pencil2,
                           const PosedView& h1,
                           const PosedView& h2,
                           const PosedView& view,
                           const std::vector<Edge2d>& edges,
                           double tolerance_px)
    : angles1_(pencil1, h1),
      angles2_(pencil2, h2),
      view_angles2_(pencil2, view),
      edges_(&edges),
      tolerance_px_(tolerance_px),
      sorted1_(EpipolarAngles(pencil1, view), edges, tolerance_px) {}

std::optional<std::int32_t> WedgeSupport::Find(const ImageEdge& edge1,
                                               const ImageEdge& edge2,
                                               const ImageEdge& projected,
                                               double max_angle_rad) const {
  const auto wedge1 = WedgeOf(angles1_, edge1.position, tolerance_px_);
  const auto wedge2 = WedgeOf(angles2_, edge2.position, tolerance_px_);
  if (!wedge1 || !wedge2) return std::nullopt;
  std::optional<std::int32_t> nearest;
  double least = 0;
  const double angle = std::atan2(projected.tangent.y(), projected.tangent.x());
  for (const std::int32_t idx : sorted1_.Meeting(*wedge1)) {
    const Edge2d& edge = (*edges_)[static_cast<std::size_t>(idx)];
    if (UndirectedDifference(static_cast<double>(edge.angle), angle) >
        max_angle_rad) {
      continue;
    }
    const auto own = WedgeOf(view_angles2_, edge.position, tolerance_px_);
    if (!own || !Meet(*own, *wedge2)) continue;
    const double distance = (edge.position - projected.position).squaredNorm();
    if (!nearest || distance < least) {
      nearest = idx;
      least = distance;
    }
  }
  return nearest;
}

namespace {

// Bounds the time of the loop over pairs of views (Sec. 3), which the share P
// of used edges may never end.
constexpr int kMaxNumViewPairs = 50;

// A hypothesis with the edges that support it, by view.
struct Validated {
  SpaceEdge edge;
  std::vector<EdgeRef> support;  // validation views, ascending
  std::vector<std::int32_t> members;
};

struct PairResult {
  std::vector<Validated> validated;
  std::int64_t hypotheses = 0;
  std::int64_t rivals = 0;
};

class PairSketcher {
 public:
  PairSketcher(const SketchInput& input,
               const ViewPair& pair,
               const HypothesisViews& hypothesis_views)
      : input_(input),
        hypothesis_views_(hypothesis_views),
        validators_(input.views.size()) {
    ParallelFor(validators_.size(),
                input.options.runtime.num_threads,
                [&](std::size_t i) {
                  if (static_cast<int>(i) == pair.h1 ||
                      static_cast<int>(i) == pair.h2) {
                    return;
                  }
                  validators_[i] = SupportIn(i);
                });
  }

  PairResult Sketch(const Edge2d& edge1) const {
    PairResult result;
    std::size_t most = 0;
    const Hypotheses found = hypothesis_views_.Hypothesise(edge1);
    for (const Hypothesis& hypothesis : found.hypotheses) {
      ++result.hypotheses;
      std::vector<EdgeRef> support = FindSupport(hypothesis);
      if (static_cast<int>(support.size()) <
          input_.options.validation.min_num_support_views) {
        continue;
      }
      most = std::max(most, support.size());
      const auto members = found.virtual_edges.MembersOf(hypothesis.edge2);
      result.validated.push_back({hypothesis.edge,
                                  std::move(support),
                                  {members.begin(), members.end()}});
    }
    const double least = kMinRelativeSupport * static_cast<double>(most);
    result.rivals += static_cast<std::int64_t>(
        std::erase_if(result.validated, [&](const Validated& v) {
          return static_cast<double>(v.support.size()) < least;
        }));
    return result;
  }

 private:
  // nullopt if the view shares its centre with a hypothesis view.
  std::optional<WedgeSupport> SupportIn(std::size_t view_idx) const {
    const PosedView& h1 = hypothesis_views_.h1();
    const PosedView& h2 = hypothesis_views_.h2();
    const PosedView& view = input_.views[view_idx];
    const auto pencil1 = EpipolarPencil::Make(h1, view);
    const auto pencil2 = EpipolarPencil::Make(h2, view);
    if (!pencil1 || !pencil2) return std::nullopt;
    return WedgeSupport(*pencil1,
                        *pencil2,
                        h1,
                        h2,
                        view,
                        input_.edge_maps[view_idx].edges,
                        input_.options.hypotheses.location_tolerance_px);
  }

  std::vector<EdgeRef> FindSupport(const Hypothesis& hypothesis) const {
    std::vector<EdgeRef> support;
    for (std::size_t i = 0; i < validators_.size(); ++i) {
      if (!validators_[i]) continue;
      const auto projected = ProjectInto(input_.views[i], hypothesis.edge);
      if (!projected) continue;
      const auto edge_idx = validators_[i]->Find(
          hypothesis.edge1,
          hypothesis.edge2.edge,
          *projected,
          DegToRad(input_.options.validation.max_angle_deg));
      if (edge_idx) {
        support.push_back({static_cast<std::int32_t>(i), *edge_idx});
      }
    }
    return support;
  }

  const SketchInput& input_;
  const HypothesisViews& hypothesis_views_;
  std::vector<std::optional<WedgeSupport>> validators_;
};

// The 2D edges of a 3D edge: the H1 edge, the member of the H2 cluster nearest
// to its middle along the line, and the supporting edges.
Edge3d ToEdge3d(const Validated& validated, const EdgeRef& h1, int h2) {
  Edge3d edge;
  edge.position = validated.edge.position;
  edge.tangent = validated.edge.tangent;
  edge.evidence = static_cast<double>(validated.support.size());
  edge.support = validated.support;
  edge.support.push_back(h1);
  edge.support.push_back({h2, validated.members[validated.members.size() / 2]});
  std::sort(edge.support.begin(), edge.support.end());
  return edge;
}

void Collect(const std::vector<PairResult>& results,
             const ViewPair& pair,
             EdgeSketch& sketch,
             UsedEdges& used) {
  for (std::size_t i = 0; i < results.size(); ++i) {
    const PairResult& result = results[i];
    const EdgeRef h1{pair.h1, static_cast<std::int32_t>(i)};
    ++sketch.counts.h1_edges;
    sketch.counts.hypotheses += result.hypotheses;
    sketch.counts.rivals += result.rivals;
    sketch.counts.unsupported +=
        result.hypotheses - result.rivals -
        static_cast<std::int64_t>(result.validated.size());
    for (const Validated& validated : result.validated) {
      sketch.edges.push_back(ToEdge3d(validated, h1, pair.h2));
      for (const EdgeRef& ref : sketch.edges.back().support) used.Mark(ref);
      for (const std::int32_t member : validated.members) {
        used.Mark({pair.h2, member});
      }
    }
  }
}

// Whether at least the share P of the edges of every view is used (Sec. 3).
bool EnoughUsed(const SketchInput& input, const UsedEdges& used) {
  for (std::size_t i = 0; i < input.edge_maps.size(); ++i) {
    const double unused = static_cast<double>(used.num_unused()[i]);
    const double all = static_cast<double>(input.edge_maps[i].edges.size());
    if (unused > (1 - input.options.hypotheses.used_edges_to_stop) * all) {
      return false;
    }
  }
  return true;
}

}  // namespace

EdgeSketch SketchByPairs(const SketchInput& input, const StepDone& step_done) {
  UsedEdges used(input.edge_maps);
  EdgeSketch sketch;
  sketch.edge_sigma_px = input.sigma_px;
  std::vector<ViewPair> done;
  while (static_cast<int>(done.size()) < kMaxNumViewPairs &&
         !EnoughUsed(input, used) &&
         step_done(static_cast<int>(done.size()), kMaxNumViewPairs)) {
    const auto pair = NextViewPair(input.distinct.overlaps,
                                   used.num_unused(),
                                   done,
                                   input.options.hypotheses);
    if (!pair) break;
    done.push_back(*pair);
    const auto h1 = static_cast<std::size_t>(pair->h1);
    const auto h2 = static_cast<std::size_t>(pair->h2);
    const auto pencil = EpipolarPencil::Make(input.views[h1], input.views[h2]);
    if (!pencil) continue;
    const HypothesisViews hypothesis_views(*pencil,
                                           input.views[h1],
                                           input.views[h2],
                                           input.edge_maps[h2].edges,
                                           input.depths[h1],
                                           input.options);
    const PairSketcher sketcher(input, *pair, hypothesis_views);
    const std::vector<Edge2d>& edges = input.edge_maps[h1].edges;
    std::vector<PairResult> results(edges.size());
    ParallelFor(edges.size(),
                input.options.runtime.num_threads,
                [&](std::size_t i) { results[i] = sketcher.Sketch(edges[i]); });
    Collect(results, *pair, sketch, used);
  }
  sketch.counts.view_pairs = static_cast<std::int64_t>(done.size());
  sketch.counts.used_edges = used.total();
  return sketch;
}

}  // namespace curvix
