// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/grow_curves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/median.h"
#include "base/parallel.h"

namespace curvix {
namespace {

// Curves that grow at the same time, for any number of threads. Those that use
// the same edges grow again, so no result depends on it.
constexpr std::size_t kNumAtOnce = 64;
// A 2D edge shows one curve: a curve claims its edges and so many to either
// side of each.
constexpr int kLinksClaimed = 2;

bool AreFree(const std::vector<EdgeRef>& refs, const UsedEdges& claimed) {
  return std::ranges::none_of(
      refs, [&](const EdgeRef& ref) { return claimed.Contains(ref); });
}

std::vector<GrownCurve> Grow(const std::vector<Edge3d>& seeds,
                             const GrowthInput& input,
                             int num_threads,
                             const StepDone& step_done) {
  UsedEdges claimed(input.edge_maps);
  const std::vector<std::size_t> order = ByFallingEvidence(seeds);
  std::vector<GrownCurve> curves;
  const auto total = static_cast<int>(order.size());
  for (std::size_t begin = 0; begin < order.size(); begin += kNumAtOnce) {
    if (step_done && !step_done(static_cast<int>(begin), total)) break;
    std::vector<Growth> growths(std::min(kNumAtOnce, order.size() - begin));
    const auto grow = [&](std::size_t k) {
      growths[k] = GrowFromSeed(seeds[order[begin + k]], input, claimed);
    };
    ParallelFor(growths.size(), num_threads, grow);
    for (std::size_t k = 0; k < growths.size(); ++k) {
      // One before it may have claimed what it found.
      if (!AreFree(growths[k].found, claimed)) grow(k);
      if (!growths[k].curve) continue;
      for (const CurveSample& sample : growths[k].curve->curve.samples) {
        MarkAlongContours(
            sample.support, input.edge_maps, kLinksClaimed, claimed);
      }
      curves.push_back(*std::move(growths[k].curve));
    }
  }
  return curves;
}

}  // namespace

std::vector<Curve> GrowCurves(const std::vector<Edge3d>& seeds,
                              const GrowthInput& input,
                              int num_threads,
                              const StepDone& step_done) {
  return KeepSignificant(
      Grow(seeds, input, num_threads, step_done), input.indices, input.options);
}

namespace {

// Joints of brick of a rendered house hardly reach this multiple of the least
// significance; long edges of painted windows beside each other do.
constexpr double kTimesAsSignificant = 4;

std::vector<EdgeRef> SupportOf(const Curve& curve) {
  std::vector<EdgeRef> support;
  for (const CurveSample& sample : curve.samples) {
    support.insert(support.end(), sample.support.begin(), sample.support.end());
  }
  return support;
}

double MeanStrength(const std::vector<EdgeRef>& edges,
                    const std::vector<ViewIndex>& indices) {
  double sum = 0;
  for (const EdgeRef& ref : edges) {
    sum += static_cast<double>(EdgeOf(ref, indices).strength);
  }
  return sum / std::max(1.0, static_cast<double>(edges.size()));
}

double SumOfEvidence(const Curve& curve) {
  double sum = 0;
  for (const CurveSample& sample : curve.samples) sum += sample.evidence;
  return sum;
}

}  // namespace

double MedianCrowding(const std::vector<EdgeRef>& edges,
                      const std::vector<ViewIndex>& indices) {
  std::vector<double> crowding;
  for (const EdgeRef& ref : edges) {
    crowding.push_back(static_cast<double>(EdgeOf(ref, indices).crowding));
  }
  return MedianOr(0, std::move(crowding));
}

std::vector<Curve> KeepSignificant(std::vector<GrownCurve> curves,
                                   const std::vector<ViewIndex>& indices,
                                   const CurveGrowthOptions& options) {
  std::vector<double> strengths;
  std::vector<bool> are_texture;
  double sum = 0;
  double num_samples = 0;
  for (const GrownCurve& grown : curves) {
    const std::vector<EdgeRef> support = SupportOf(grown.curve);
    are_texture.push_back(options.IsTexture(MedianCrowding(support, indices)));
    const auto size = static_cast<double>(grown.curve.samples.size());
    strengths.push_back(MeanStrength(support, indices));
    sum += size * strengths.back();
    num_samples += size;
  }
  const double typical_strength = sum / std::max(1.0, num_samples);
  std::vector<Curve> kept;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto num_looks =
        static_cast<double>(std::max<std::int64_t>(1, curves[i].num_looks));
    const double contrast =
        typical_strength > 0 ? strengths[i] / typical_strength : 1;
    const double significance =
        SumOfEvidence(curves[i].curve) / std::sqrt(num_looks) * contrast;
    const double factor = are_texture[i] ? kTimesAsSignificant : 1;
    if (significance >= factor * options.min_significance) {
      kept.push_back(std::move(curves[i].curve));
    }
  }
  return kept;
}

}  // namespace curvix
