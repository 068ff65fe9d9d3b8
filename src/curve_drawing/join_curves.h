// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering), after Sec. 6. Small gaps closed.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Joins ends of open curves that continue each other: seen from either end, the
// other lies ahead, at most options.max_gap_px away, at most
// kMaxNormalDistancePx off the tangent line of the end, at an angle of at most
// options.max_angle_deg to it, and its own direction differs by no more. The
// nearest ends are joined first, where distance across counts twice; ties: the
// order of curves. A curve whose own ends meet becomes closed. A joined curve
// takes index and direction of the first of its curves.
//
// Deviation: the paper's curves end where an edge has no neighbour; single
// missing edges then break them. options.max_gap_px = 0 returns the input.
std::vector<Curve> JoinCurves(std::vector<Curve> curves,
                              const std::vector<PosedView>& views,
                              const ConnectivityOptions& options);

}  // namespace curvix
