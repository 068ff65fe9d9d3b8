// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "refinement/refine_curves.h"

#include "refinement/meet_at_junctions.h"
#include "refinement/select_curves.h"
#include "refinement/smooth_curves.h"

namespace curvix {

std::vector<Curve> RefineCurves(const std::vector<Curve>& curves,
                                const std::vector<PosedView>& views,
                                const CurveRefinementOptions& options,
                                int num_threads) {
  if (!options.enabled) return curves;
  const std::vector<Curve> selected = SelectCurves(curves, views, options);
  return MeetAtJunctions(
      SmoothCurves(selected, views, options, num_threads), views, options);
}

}  // namespace curvix
