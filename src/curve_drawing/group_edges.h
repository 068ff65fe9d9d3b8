// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 6. From 3D edges to curves, step by step.
#pragma once

#include <curvix/curves.h>
#include <curvix/edges.h>
#include <curvix/options.h>
#include <vector>

#include "base/cancelled.h"
#include "model/neighborhood_graph.h"
#include "model/posed_view.h"

namespace curvix {

// Ordered curves from aligned edges and their neighborhood graph: thinned,
// connected, traced, drawn once, joined, cut at corners, the short ones
// dropped. Between these steps `step_done` is asked; if it says false, the
// result is empty.
std::vector<Curve> GroupEdges(const std::vector<Edge3d>& edges,
                              const NeighborhoodGraph& graph,
                              const std::vector<PosedView>& views,
                              const ConnectivityOptions& options,
                              int num_threads,
                              const StepDone& step_done = {});

}  // namespace curvix
