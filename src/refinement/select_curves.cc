// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "refinement/select_curves.h"

#include <algorithm>
#include <utility>

#include "base/median.h"
#include "geometry/pixel_size.h"

namespace curvix {
namespace {

bool IsConfirmed(const Curve& curve,
                 const std::vector<PosedView>& views,
                 const CurveRefinementOptions& options) {
  std::vector<double> evidence, sigma_px;
  for (const CurveSample& sample : curve.samples) {
    const double pixel = PixelSize(sample.position, sample.support, views);
    if (!(sample.sigma > 0) || !(pixel > 0)) continue;
    evidence.push_back(sample.evidence);
    sigma_px.push_back(sample.sigma / pixel);
  }
  if (evidence.empty()) return true;
  const double ratio =
      std::max(1.0, Median(std::move(sigma_px)) / options.sigma_scale_px);
  return Median(std::move(evidence)) >= options.min_evidence * ratio * ratio;
}

}  // namespace

std::vector<Curve> SelectCurves(std::vector<Curve> curves,
                                const std::vector<PosedView>& views,
                                const CurveRefinementOptions& options) {
  std::erase_if(curves, [&](const Curve& curve) {
    return !IsConfirmed(curve, views, options);
  });
  return curves;
}

}  // namespace curvix
