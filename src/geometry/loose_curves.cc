// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "geometry/loose_curves.h"

#include <utility>

#include "geometry/pixel_size.h"
#include "model/curve_junctions.h"

namespace curvix {

bool IsShort(const Curve& curve,
             const std::vector<PosedView>& views,
             double min_length_px) {
  return curve.samples.size() < 2 ||
         LengthInPixels(curve, views) < min_length_px;
}

bool LeadsSomewhere(const Curve& curve) {
  return curve.start_junction >= 0 && curve.end_junction >= 0 &&
         curve.start_junction != curve.end_junction;
}

std::vector<Curve> DropLooseShortCurves(std::vector<Curve> curves,
                                        const std::vector<PosedView>& views,
                                        double min_length_px) {
  CurveSet set{std::move(curves), {}};
  IndexJunctions(set);
  std::erase_if(set.curves, [&](const Curve& curve) {
    return !LeadsSomewhere(curve) && IsShort(curve, views, min_length_px);
  });
  return std::move(set.curves);
}

}  // namespace curvix
