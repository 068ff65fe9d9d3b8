// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Whole curves.
#include "curve_refinement/refine_curves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/parallel.h"
#include "base/point_tree.h"
#include "curve_refinement/curve_ends.h"
#include "geometry/pixel_size.h"
#include "model/curve_chains.h"

namespace curvix {
namespace {

constexpr double kMaxBridgeMissPx = 1;
constexpr double kMaxMissPerGap = 0.1;
constexpr double kMaxBridgeAngleDeg = 15;
constexpr double kRingTolerance = 3;
// Curves whose ends are further apart do not close, even after cuts.
constexpr double kMaxRingGapPx = 100;
constexpr double kMaxOverlapPx = 6;
constexpr double kMaxBentPx = 5;  // of an end
constexpr double kMaxOffPx = 0.4;
constexpr double kCostOfGap = 0.05;  // per length; a miss costs its length

// How far from `to` the fit of `from`, carried on, passes; nullopt if it does
// not arrive there.
std::optional<double> Miss(const EndFit& from,
                           const EndFit& to,
                           double max_miss,
                           double max_angle_deg,
                           double max_overlap) {
  const double arc_length = from.ArcLengthTo(to.position);
  const double miss = (from.PointAt(arc_length) - to.position).norm();
  const double cosine = from.DirectionAt(arc_length).dot(-to.outward);
  if (arc_length < -max_overlap || miss > max_miss ||
      cosine < std::cos(DegToRad(max_angle_deg))) {
    return std::nullopt;
  }
  return miss;
}

// Finds the pairs of ends that continue each other.
class GapFinder {
 public:
  GapFinder(const std::vector<Curve>& curves,
            const std::vector<EndFit>& ends,
            const ImageSupport& images,
            const RefinementInput& input)
      : curves_(curves), ends_(ends), images_(images), input_(input) {}

  // If `only_rings`, those of one curve.
  std::vector<EndPair> Pairs(bool only_rings) const {
    const PointTree tree(ends_, &EndFit::position);
    std::vector<std::vector<EndPair>> pairs(ends_.size());
    ParallelFor(ends_.size(), input_.num_threads, [&](EndIdx a) {
      if (!(ends_[a].length > 0)) return;
      const double reach =
          std::max(input_.options.max_gap_px * ends_[a].pixel, ends_[a].length);
      for (const EndIdx b : tree.Within(ends_[a].position, reach)) {
        if (b == a || (only_rings && b != OtherEnd(a))) continue;
        if (const auto cost = Cost(a, b)) pairs[a].push_back({*cost, a, b});
      }
    });
    return Concatenate(std::move(pairs));
  }

 private:
  // Of joining the two ends, world units; nullopt if they do not continue each
  // other.
  std::optional<double> Cost(EndIdx a, EndIdx b) const {
    const EndFit& from = ends_[a];
    const EndFit& to = ends_[b];
    const double unit = std::min(from.pixel, to.pixel);
    const double gap = (to.position - from.position).norm();
    const double longest = std::min(from.length, to.length);
    if (!(gap > 0) || gap > longest) return std::nullopt;
    // The two ends of one curve hardly meet by chance.
    const double tolerance = ItemOf(a) == ItemOf(b) ? kRingTolerance : 1;
    const bool is_long = gap > input_.options.max_gap_px * unit;
    const double max_miss = tolerance * (kMaxBridgeMissPx * unit +
                                         (is_long ? 0 : kMaxMissPerGap * gap));
    const auto miss = [&](const EndFit& a_fit, const EndFit& b_fit) {
      return Miss(a_fit,
                  b_fit,
                  max_miss,
                  tolerance * kMaxBridgeAngleDeg,
                  kMaxOverlapPx * unit);
    };
    const auto forth = miss(from, to);
    const auto back = miss(to, from);
    if (!forth || !back || (is_long && !ImagesShow(a, b, unit))) {
      return std::nullopt;
    }
    return kCostOfGap * gap + std::max(*forth, *back);
  }

  bool ImagesShow(EndIdx a, EndIdx b, double unit) const {
    const Curve& curve_a = curves_[ItemOf(a)];
    const Curve& curve_b = curves_[ItemOf(b)];
    CurveSample from = SampleFromEnd(curve_a, IsHead(a));
    CurveSample to = SampleFromEnd(curve_b, IsHead(b));
    from.tangent = ends_[a].outward;
    to.tangent = -ends_[b].outward;
    const double usual = std::min(SupportBefore(curve_a, IsHead(a)),
                                  SupportBefore(curve_b, IsHead(b)));
    return IsGapShown(from, to, unit, usual, images_);
  }

  const std::vector<Curve>& curves_;
  const std::vector<EndFit>& ends_;
  const ImageSupport& images_;
  const RefinementInput& input_;
};

bool MayBecomeRing(const Curve& curve, const std::vector<PosedView>& views) {
  const CurveSample& head = SampleFromEnd(curve, true);
  const CurveSample& tail = SampleFromEnd(curve, false);
  return (head.position - tail.position).norm() <=
         kMaxRingGapPx * PixelSize(head, views);
}

// Last samples that leave the curve they end, as next to a corner.
void CutBentEnds(const std::vector<PosedView>& views, Curve& curve) {
  for (const bool at_head : {true, false}) {
    const EndFit fit = FitLongEnd(curve, at_head, views);
    if (!(fit.length > 3 * kMaxBentPx * fit.pixel)) continue;
    CutEnd(curve, at_head, [&](const CurveSample& sample) {
      const double arc_length = fit.ArcLengthTo(sample.position);
      return arc_length < -kMaxBentPx * fit.pixel ||
             (fit.PointAt(arc_length) - sample.position).norm() <=
                 kMaxOffPx * fit.pixel;
    });
  }
}

// Cuts tied ends back to the last sample that they have in `trimmed`.
void CutTiedEnds(const EndTies& ties,
                 const std::vector<Curve>& trimmed,
                 std::vector<Curve>& curves) {
  for (EndIdx end = 0; end < ties.size(); ++end) {
    if (!ties[end]) continue;
    const bool at_head = IsHead(end);
    const Eigen::Vector3d& last =
        SampleFromEnd(trimmed[ItemOf(end)], at_head).position;
    CutEnd(curves[ItemOf(end)], at_head, [&](const CurveSample& sample) {
      return sample.position == last;
    });
  }
}

// Ends that are tied and run past each other are cut half-way.
void CutOverlaps(const EndTies& ties,
                 const std::vector<EndFit>& ends,
                 std::vector<Curve>& curves) {
  for (EndIdx a = 0; a < ties.size(); ++a) {
    if (!ties[a]) continue;
    const EndFit& from = ends[a];
    const double overlap = -from.ArcLengthTo(ends[*ties[a]].position);
    if (!(overlap > 0)) continue;
    CutEnd(curves[ItemOf(a)], IsHead(a), [&](const CurveSample& sample) {
      return from.ArcLengthTo(sample.position) < -overlap / 2;
    });
  }
}

// Joins ends that continue each other; if `only_rings`, those of one curve.
std::vector<Curve> Join(std::vector<Curve> curves,
                        const RefinementInput& input,
                        const ImageSupport& images,
                        bool only_rings) {
  std::vector<Curve> trimmed = curves;
  std::vector<EndFit> ends(2 * curves.size());  // by EndIdx
  ParallelFor(curves.size(), input.num_threads, [&](std::size_t i) {
    if (only_rings && !MayBecomeRing(curves[i], input.views)) return;
    CutBentEnds(input.views, trimmed[i]);
    for (const EndIdx end : {2 * i, 2 * i + 1}) {
      ends[end] = FitLongEnd(trimmed[i], IsHead(end), input.views);
    }
  });
  const EndTies ties = TieCheapestFirst(
      GapFinder(trimmed, ends, images, input).Pairs(only_rings), curves.size());
  CutTiedEnds(ties, trimmed, curves);
  CutOverlaps(ties, ends, curves);
  return StringTogetherFilled(std::move(curves), ties, images);
}

}  // namespace

std::vector<Curve> BridgeGaps(std::vector<Curve> curves,
                              const RefinementInput& input,
                              const ImageSupport& images) {
  if (!(input.options.max_gap_px > 0)) return curves;
  // Curves that are whole after the first time may close.
  for (const bool only_rings : {false, true}) {
    curves = Join(std::move(curves), input, images, only_rings);
  }
  return curves;
}

}  // namespace curvix
