// SPDX-License-Identifier: BSD-3-Clause
// Paper: Secs. 3 and 4. The 3D edge sketch: hypothesise, consolidate, validate.
#pragma once

#include <curvix/edges.h>
#include <curvix/options.h>
#include <curvix/scene.h>
#include <vector>

#include "edge_sketch/sketch_input.h"
#include "model/posed_view.h"

namespace curvix {

// Whether curves grow from 3D edges (curve_drawing/grow_curves.h), or 3D edges
// are linked and connected (paper, Secs. 5 and 6).
bool CurvesGrow(const std::vector<EdgeMap>& edge_maps, const Options& options);

// As in the paper (pairs of views, support in wedges) or by every view with its
// partners and tracked support: options.hypotheses.view_selection.
EdgeSketch SketchViews(const std::vector<PosedView>& views,
                       const std::vector<EdgeMap>& edge_maps,
                       const std::vector<ScenePoint>& points,
                       const Options& options,
                       const StepDone& step_done);

}  // namespace curvix
