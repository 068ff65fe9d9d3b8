// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 6. Curves from the connectivity graph.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>

#include <vector>

#include "model/connectivity_graph.h"
#include "model/posed_view.h"

namespace curvix {

// Walks from the smallest untraced edge forwards to the end, then backwards,
// until every edge has been visited. Returns the walks in the order of their
// smallest edges; samples in walking order, tangents along the curve, support
// carried over. A walk that returns to its start is a closed curve. Every edge
// is in exactly one curve, once; an edge without neighbours is a curve of one
// sample, for JoinCurves to take up or DropShortCurves to drop.
std::vector<Curve> TraceCurves(const std::vector<Edge3d>& edges,
                               const ConnectivityGraph& graph);

// The curves of at least two samples that are at least `min_length_px` long, in
// the same order.
std::vector<Curve> DropShortCurves(std::vector<Curve> curves,
                                   const std::vector<PosedView>& views,
                                   double min_length_px);

}  // namespace curvix
