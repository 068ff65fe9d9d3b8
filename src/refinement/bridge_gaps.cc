// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "refinement/bridge_gaps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/point_tree.h"
#include "geometry/pixel_size.h"
#include "model/curve_chains.h"
#include "refinement/end_fit.h"

namespace curvix {
namespace {

constexpr double kMaxMissPx = 1;
constexpr double kMaxMissPerGap = 0.1;
constexpr double kMaxAngleDeg = 15;
constexpr double kRingTolerance = 3;
constexpr double kMaxOverlapPx = 6;
constexpr double kMaxBentPx = 5;  // of an end
constexpr double kMaxOffPx = 0.4;
constexpr double kCostOfGap = 0.05;  // a pixel of miss is a pixel
constexpr double kFillSpacingPx = 1.5;

// Support of the samples in a gap.
constexpr double kMaxSupportDistancePx = 1;
constexpr double kMinSupportShare = 0.5;    // of that of the ends
constexpr double kMinSupportedShare = 0.8;  // of the samples
constexpr std::size_t kNumEndSamples = 10;

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

// Samples on the cubic through both ends with their tangents.
std::vector<CurveSample> Fill(const CurveSample& from,
                              const CurveSample& to,
                              double spacing) {
  const double gap = (to.position - from.position).norm();
  const int num_pieces = static_cast<int>(gap / spacing) + 1;
  std::vector<CurveSample> filled;
  for (int k = 1; k < num_pieces; ++k) {
    const double u = static_cast<double>(k) / num_pieces;
    const double v = 1 - u;
    CurveSample& sample = filled.emplace_back();
    sample.position = (1 + 2 * u) * v * v * from.position +
                      (1 + 2 * v) * u * u * to.position +
                      gap * u * v * (v * from.tangent - u * to.tangent);
    sample.tangent = (v * from.tangent + u * to.tangent).normalized();
    sample.sigma = std::max(from.sigma, to.sigma);
    sample.evidence = std::min(from.evidence, to.evidence);
  }
  return filled;
}

// Finds the pairs of ends that continue each other.
class GapFinder {
 public:
  GapFinder(const std::vector<Curve>& curves,
            const std::vector<PosedView>& views,
            const ImageSupport& images,
            const CurveRefinementOptions& options)
      : curves_(curves), images_(images), options_(options) {
    for (const Curve& curve : curves) {
      ends_.push_back(FitLongEnd(curve, true, views));
      ends_.push_back(FitLongEnd(curve, false, views));
    }
  }

  std::vector<EndPair> Pairs() const {
    std::vector<Eigen::Vector3d> positions;
    for (const EndFit& end : ends_) positions.push_back(end.position);
    const PointTree tree(std::move(positions));
    std::vector<EndPair> pairs;
    for (EndIdx a = 0; a < ends_.size(); ++a) {
      if (!(ends_[a].length > 0)) continue;
      const double reach =
          std::max(options_.max_gap_px * ends_[a].pixel, ends_[a].length);
      for (const EndIdx b : tree.Within(ends_[a].position, reach)) {
        if (b == a) continue;
        if (const auto cost = Cost(a, b)) pairs.push_back({*cost, a, b});
      }
    }
    return pairs;
  }

 private:
  std::optional<double> Cost(EndIdx a, EndIdx b) const {
    const EndFit& from = ends_[a];
    const EndFit& to = ends_[b];
    const double unit = std::min(from.pixel, to.pixel);
    const double gap = (to.position - from.position).norm();
    const double longest = std::min(from.length, to.length);
    if (!(gap > 0) || gap > longest) return std::nullopt;
    // The two ends of one curve hardly meet by chance.
    const double tolerance = ItemOf(a) == ItemOf(b) ? kRingTolerance : 1;
    const bool is_long = gap > options_.max_gap_px * unit;
    const double max_miss =
        tolerance * (kMaxMissPx * unit + (is_long ? 0 : kMaxMissPerGap * gap));
    const auto forth = Miss(
        from, to, max_miss, tolerance * kMaxAngleDeg, kMaxOverlapPx * unit);
    const auto back = Miss(
        to, from, max_miss, tolerance * kMaxAngleDeg, kMaxOverlapPx * unit);
    if (!forth || !back || (is_long && !ImagesShow(a, b, unit))) {
      return std::nullopt;
    }
    return kCostOfGap * gap + std::max(*forth, *back);
  }

  const CurveSample& Sample(EndIdx end, std::size_t k) const {
    const std::vector<CurveSample>& samples = curves_[ItemOf(end)].samples;
    return samples[IsFront(end) ? samples.size() - 1 - k : k];
  }

  // The median number of 2D edges of the samples before an end.
  std::size_t SupportAt(EndIdx end) const {
    const std::size_t num_samples =
        std::min(kNumEndSamples, curves_[ItemOf(end)].samples.size());
    std::vector<std::size_t> counts;
    for (std::size_t k = 0; k < num_samples; ++k) {
      counts.push_back(Sample(end, k).support.size());
    }
    std::sort(counts.begin(), counts.end());
    return counts[counts.size() / 2];
  }

  bool ImagesShow(EndIdx a, EndIdx b, double unit) const {
    CurveSample from = Sample(a, 0);
    CurveSample to = Sample(b, 0);
    from.tangent = ends_[a].outward;
    to.tangent = -ends_[b].outward;
    const auto least = static_cast<std::size_t>(
        std::ceil(kMinSupportShare *
                  static_cast<double>(std::min(SupportAt(a), SupportAt(b)))));
    const auto filled = Fill(from, to, kFillSpacingPx * unit);
    const auto num_shown =
        std::count_if(filled.begin(), filled.end(), [&](const auto& sample) {
          return images_
                     .Find(
                         sample.position, sample.tangent, kMaxSupportDistancePx)
                     .size() >= least;
        });
    return static_cast<double>(num_shown) >=
           kMinSupportedShare * static_cast<double>(filled.size());
  }

  const std::vector<Curve>& curves_;
  const ImageSupport& images_;
  const CurveRefinementOptions& options_;
  std::vector<EndFit> ends_;
};

// Cuts the last samples up to the one nearest to the end that `keep` is true
// for; two stay.
template <typename Keep>
void CutEnd(Curve& curve, bool front, const Keep& keep) {
  std::vector<CurveSample>& samples = curve.samples;
  if (!front) std::reverse(samples.begin(), samples.end());
  while (samples.size() > 2 && !keep(samples.back())) samples.pop_back();
  if (!front) std::reverse(samples.begin(), samples.end());
}

// Last samples that leave the curve they end, as next to a corner.
void CutBentEnds(const std::vector<PosedView>& views, Curve& curve) {
  for (const bool front : {true, false}) {
    const EndFit fit = FitLongEnd(curve, front, views);
    if (!(fit.length > 3 * kMaxBentPx * fit.pixel)) continue;
    CutEnd(curve, front, [&](const CurveSample& sample) {
      const double arc_length = fit.ArcLengthTo(sample.position);
      return arc_length < -kMaxBentPx * fit.pixel ||
             (fit.PointAt(arc_length) - sample.position).norm() <=
                 kMaxOffPx * fit.pixel;
    });
  }
}

// Ends that are tied and run past each other are cut half-way.
void CutOverlaps(const EndTies& ties,
                 const std::vector<PosedView>& views,
                 std::vector<Curve>& curves) {
  const std::vector<Curve> before = curves;
  for (EndIdx a = 0; a < ties.size(); ++a) {
    if (!ties[a]) continue;
    const EndIdx b = *ties[a];
    const EndFit from = FitLongEnd(before[ItemOf(a)], IsFront(a), views);
    const EndFit to = FitLongEnd(before[ItemOf(b)], IsFront(b), views);
    const double overlap = -from.ArcLengthTo(to.position);
    if (!(overlap > 0)) continue;
    CutEnd(curves[ItemOf(a)], IsFront(a), [&](const CurveSample& sample) {
      return from.ArcLengthTo(sample.position) < -overlap / 2;
    });
  }
}

std::vector<Curve> Join(std::vector<Curve> curves,
                        const EndTies& ties,
                        const std::vector<PosedView>& views,
                        const ImageSupport& images) {
  CutOverlaps(ties, views, curves);
  return StringTogether(
      std::move(curves),
      ties,
      [&](const CurveSample& from, const CurveSample& to) {
        const double pixel = PixelSize(from.position, from.support, views);
        auto filled = Fill(from, to, kFillSpacingPx * pixel);
        for (CurveSample& sample : filled) {
          sample.support = images.Find(
              sample.position, sample.tangent, kMaxSupportDistancePx);
        }
        return filled;
      });
}

}  // namespace

std::vector<Curve> BridgeGaps(std::vector<Curve> curves,
                              const std::vector<PosedView>& views,
                              const ImageSupport& images,
                              const CurveRefinementOptions& options) {
  if (!(options.max_gap_px > 0)) return curves;
  for (Curve& curve : curves) CutBentEnds(views, curve);
  std::vector<EndPair> pairs =
      GapFinder(curves, views, images, options).Pairs();
  EndTies ties = TieCheapestFirst(std::move(pairs), curves.size());
  curves = Join(std::move(curves), ties, views, images);

  pairs = GapFinder(curves, views, images, options).Pairs();
  std::erase_if(pairs, [](const EndPair& pair) {
    return ItemOf(pair.a) != ItemOf(pair.b);
  });
  ties = TieCheapestFirst(std::move(pairs), curves.size());
  return Join(std::move(curves), ties, views, images);
}

}  // namespace curvix
