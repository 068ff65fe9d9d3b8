// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Which of the curves a person wants to see.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/options.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// What the filters look at.
struct CurveQualities {
  double length_px = 0;     // in pixels of the views that see it largest
  double num_views = 0;     // that support a sample; median
  double contrast = 0;      // of the 2D edges, grey levels per pixel; median
  double sigma_px = 0;      // median; 0: not known
  double straightness = 1;  // CurveFilterOptions::min_straightness
};

// `curve` must have samples; its support must be in `edge_maps`.
CurveQualities Measure(const Curve& curve,
                       const std::vector<PosedView>& views,
                       const std::vector<EdgeMap>& edge_maps);

// The curves, in order, that pass every filter, first that of kinds. The
// defaults let all pass.
std::vector<Curve> FilterCurves(std::vector<Curve> curves,
                                const std::vector<PosedView>& views,
                                const std::vector<EdgeMap>& edge_maps,
                                const CurveFilterOptions& options);

}  // namespace curvix
