// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/keep_significant.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/median.h"

namespace curvix {
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
