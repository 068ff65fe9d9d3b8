// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, Fig. 3(c). One view and the means to find its edges.
#pragma once

#include <curvix/edges.h>
#include <vector>

#include "base/grid_index.h"
#include "edge_sketch/edge_density.h"
#include "geometry/adjust_edge.h"
#include "geometry/edge_geometry.h"
#include "model/posed_view.h"

namespace curvix {

// What validation needs of a view, made once.
struct ViewIndex {
  const PosedView* view = nullptr;
  const EdgeMap* edges = nullptr;
  GridIndex grid;
  EdgeDensity density;
  EdgePresence presence = {};  // may be left out
};

// `views` by view index.
const Edge2d& EdgeOf(const EdgeRef& ref, const std::vector<ViewIndex>& views);
PlaneMeasurement MeasurePlane(const EdgeRef& ref,
                              const std::vector<ViewIndex>& views);

// The vote of a view (evidence.h) in which a 3D edge projects to `projected`
// and the edge `support` supports it. `expected_px` is the expected standard
// deviation of the distance between the two.
double VoteWithSupport(const ViewIndex& view,
                       const ImageEdge& projected,
                       double expected_px,
                       const ImageEdge& support);

}  // namespace curvix
