// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Whether poses refined with curves are better.
#pragma once

#include <curvix/refine_poses.h>

#include <vector>

#include "pipeline/posed_edges.h"

namespace curvix {

// Moves every fifth part of space out of `places`: of the cubes of a tenth of
// the places' median distance from their median, every fifth.
std::vector<CurvePlace> TakeCheckPlaces(std::vector<CurvePlace>* places);

// Compares the motions of `edges` with none by places that were held out, each
// fitted anew to either poses. Views in which the places do not come nearer to
// their edges, or which show too few of them, lose their motion; all do if that
// is not enough. See RefinePosesWithCurves. num_samples is left for the caller.
CurvePoses JudgeMotions(const std::vector<CurvePlace>& check_places,
                        const Scene& scene,
                        int num_threads,
                        PosedEdges* edges);

}  // namespace curvix
