// SPDX-License-Identifier: BSD-3-Clause
#include "curve_drawing/keep_significant.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace curvix {
namespace {

double MeanStrength(const Curve& curve, const std::vector<ViewIndex>& indices) {
  double sum = 0;
  double count = 0;
  for (const CurveSample& sample : curve.samples) {
    for (const EdgeRef& ref : sample.support) {
      const EdgeMap& map =
          *indices[static_cast<std::size_t>(ref.view_idx)].edges;
      sum += map.edges[static_cast<std::size_t>(ref.edge_idx)].strength;
      count += 1;
    }
  }
  return sum / std::max(1.0, count);
}

double SumOfEvidence(const Curve& curve) {
  double sum = 0;
  for (const CurveSample& sample : curve.samples) sum += sample.evidence;
  return sum;
}

}  // namespace

std::vector<Curve> KeepSignificant(std::vector<GrownCurve> curves,
                                   const std::vector<ViewIndex>& indices,
                                   double min_significance) {
  std::vector<double> strengths;
  double sum = 0;
  double num_samples = 0;
  for (const GrownCurve& grown : curves) {
    const auto size = static_cast<double>(grown.curve.samples.size());
    strengths.push_back(MeanStrength(grown.curve, indices));
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
    if (significance >= min_significance) {
      kept.push_back(std::move(curves[i].curve));
    }
  }
  return kept;
}

}  // namespace curvix
