// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it).
#include "refinement/refine_curves.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "refinement/bridge_gaps.h"
#include "refinement/meet_at_junctions.h"
#include "refinement/select_curves.h"
#include "refinement/smooth_curves.h"

namespace curvix {
namespace {

// Evidence adds up over views, so what can be asked of a curve grows with them:
// options.min_evidence is for this many or more.
constexpr double kFullNumViews = 50;

CurveRefinementOptions ForNumViews(CurveRefinementOptions options,
                                   std::size_t num_views) {
  options.min_evidence *=
      std::min(1.0, static_cast<double>(num_views) / kFullNumViews);
  return options;
}

}  // namespace

std::vector<Curve> RefineCurves(const std::vector<Curve>& curves,
                                const std::vector<PosedView>& views,
                                const CurveRefinementOptions& options,
                                int num_threads) {
  if (!options.enabled) return curves;
  std::vector<Curve> refined =
      SelectCurves(curves, views, ForNumViews(options, views.size()));
  refined = SmoothCurves(refined, views, options, num_threads);
  refined = BridgeGaps(std::move(refined), views, options);
  return MeetAtJunctions(std::move(refined), views, options);
}

}  // namespace curvix
