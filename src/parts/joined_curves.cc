// SPDX-License-Identifier: BSD-3-Clause
#include "parts/joined_curves.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "geometry/pixel_size.h"
#include "model/sample_ranges.h"
#include "parts/scene_parts.h"

namespace curvix {
namespace {

// Shortest step from one segment to the next, pixels.
constexpr double kMinStepPx = 0.5;

// The ties among the items of a chain, by their ranks in `items`, which are
// ascending.
EndTies TiesAmong(const std::vector<std::size_t>& items, const EndTies& ties) {
  EndTies among;
  for (const std::size_t item : items) {
    for (const EndIdx end : {2 * item, 2 * item + 1}) {
      std::optional<EndIdx>& tie = among.emplace_back();
      if (!ties[end]) continue;
      const auto rank =
          std::ranges::lower_bound(items, ItemOf(*ties[end])) - items.begin();
      tie = 2 * static_cast<std::size_t>(rank) + *ties[end] % 2;
    }
  }
  return among;
}

// Removes the samples of the second curve beside the first, not beyond it.
void TrimSecond(EndIdx first,
                EndIdx second,
                const std::vector<PosedView>& views,
                std::vector<Curve>& curves) {
  const Curve& curve = curves[ItemOf(first)];
  const CurveSample& from = SampleFromEnd(curve, IsHead(first));
  const Eigen::Vector3d outward =
      IsHead(first) ? from.tangent : Eigen::Vector3d(-from.tangent);
  const double min_step = kMinStepPx * PixelSize(from, views);
  std::vector<CurveSample>& next = curves[ItemOf(second)].samples;
  while (next.size() > 2) {
    const auto nearest = IsHead(second) ? next.end() - 1 : next.begin();
    if (outward.dot(nearest->position - from.position) >= min_step) break;
    next.erase(nearest);
  }
}

// The places of the ends of a curve, without the rest.
Curve EndsOf(const Curve& curve) {
  Curve ends;
  ends.closed = curve.closed;
  ends.samples.resize(2);
  ends.samples.front().position = curve.samples.front().position;
  ends.samples.back().position = curve.samples.back().position;
  return ends;
}

}  // namespace

JoinedCurves::JoinedCurves(const ScenePartition& partition,
                           PartResults& parts,
                           const Scene& scene,
                           const Options& options)
    : partition_(partition), parts_(parts), views_(MakePosedViews(scene)) {
  part_curves_ = ReadPartCurves();
  if (!status_.ok()) return;
  tied_ = TieSegments(partition, part_curves_, options.connectivity);
  for (PartCurve& part_curve : part_curves_) part_curve.border_samples = {};
  chains_ = FollowEnds(tied_.ties);
  DropLooseShortCurves(options.curve_refinement.min_length_px);
}

std::vector<PartCurve> JoinedCurves::ReadPartCurves() const {
  const auto cores = CoresOf(partition_);
  std::vector<PartCurve> part_curves;
  for (std::size_t i = 0; i < partition_.parts.size(); ++i) {
    const int part_idx = static_cast<int>(i);
    for (std::size_t k = 0; k < parts_.NumCurves(part_idx); ++k) {
      const Result<TracedCurve> traced = Read(part_idx, k);
      if (!traced.ok()) {
        status_ = traced.status();
        return {};
      }
      part_curves.push_back(MakePartCurve(
          part_idx, k, traced->curve, cores[i], partition_.overlap, views_));
    }
  }
  return part_curves;
}

// A curve of a part, which names views of the scene.
Result<TracedCurve> JoinedCurves::Read(int part_idx,
                                       std::size_t curve_idx) const {
  CURVIX_ASSIGN_OR_RETURN(TracedCurve traced, parts_.Read(part_idx, curve_idx));
  const std::vector<int>& view_idxs =
      partition_.parts[static_cast<std::size_t>(part_idx)].view_idxs;
  bool is_sound = !traced.curve.samples.empty();
  ForEachSupport(traced.curve, [&](EdgeRef& ref) {
    const auto view_idx = static_cast<std::size_t>(ref.view_idx);
    const auto edge_idx = static_cast<std::size_t>(ref.edge_idx);
    if (view_idx >= view_idxs.size() || edge_idx >= traced.edges.size()) {
      is_sound = false;
      return;
    }
    ref.view_idx = view_idxs[view_idx];
  });
  if (is_sound) return traced;
  return Status::DataLoss(
      "A curve of part " + std::to_string(part_idx) +
      " names views or edges that are not there; reconstruct this part again");
}

Result<TracedCurve> JoinedCurves::Join(const EndChain& chain) const {
  std::vector<std::size_t> items;
  for (const ChainItem& link : chain.items) items.push_back(link.item);
  std::ranges::sort(items);
  TracedCurve joined;
  std::vector<Curve> curves;
  for (const std::size_t item : items) {
    const CurveSegment& segment = tied_.segments[item];
    const PartCurve& part_curve = part_curves_[segment.curve];
    CURVIX_ASSIGN_OR_RETURN(TracedCurve traced,
                            Read(part_curve.part_idx, part_curve.curve_idx));
    curves.push_back(TakeOut(traced.curve, segment.range));
    joined.edges.reserve(joined.edges.size() + traced.edges.size());
    ForEachSupport(curves.back(), [&](EdgeRef& ref) {
      joined.edges.push_back(
          traced.edges[static_cast<std::size_t>(ref.edge_idx)]);
      ref.edge_idx = static_cast<std::int32_t>(joined.edges.size() - 1);
    });
  }
  const EndTies ties = TiesAmong(items, tied_.ties);
  for (EndIdx end = 0; end < ties.size(); ++end) {
    if (ties[end] && end < *ties[end]) {
      TrimSecond(end, *ties[end], views_, curves);
    }
  }
  joined.curve = StringTogether(std::move(curves), ties, {}).front();
  return joined;
}

void JoinedCurves::DropLooseShortCurves(double min_length_px) {
  CurveSet ends;
  std::vector<bool> are_short;
  ForEach([&](std::size_t, const Curve& curve) {
    ends.curves.push_back(EndsOf(curve));
    are_short.push_back(IsShort(curve, views_, min_length_px));
  });
  if (!status_.ok()) return;
  IndexJunctions(ends);
  std::vector<EndChain> kept;
  for (std::size_t i = 0; i < chains_.size(); ++i) {
    if (!are_short[i] || LeadsSomewhere(ends.curves[i])) {
      kept.push_back(std::move(chains_[i]));
    }
  }
  chains_ = std::move(kept);
}

void JoinedCurves::ForEach(const Visit& visit) const {
  for (std::size_t id = 0; status_.ok() && id < chains_.size(); ++id) {
    edges_ = std::vector<Edge2d>();  // before there are others
    Result<TracedCurve> joined = Join(chains_[id]);
    if (!joined.ok()) {
      status_ = joined.status();
      return;
    }
    edges_ = std::move(joined->edges);
    visit(id, joined->curve);
  }
}

}  // namespace curvix
