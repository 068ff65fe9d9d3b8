// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "refinement/refine_curves.h"

#include <utility>

#include "refinement/bridge_gaps.h"
#include "refinement/meet_at_junctions.h"
#include "refinement/select_curves.h"
#include "refinement/smooth_curves.h"

namespace curvix {

std::vector<Curve> RefineCurves(const std::vector<Curve>& curves,
                                const std::vector<PosedView>& views,
                                const CurveRefinementOptions& options,
                                int num_threads) {
  if (!options.enabled) return curves;
  std::vector<Curve> refined = SelectCurves(curves, views, options);
  refined = SmoothCurves(refined, views, options, num_threads);
  refined = BridgeGaps(std::move(refined), views, options);
  return MeetAtJunctions(std::move(refined), views, options);
}

}  // namespace curvix
