// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering), after Sec. 6. Small gaps closed.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Joins ends of open curves that continue each other: seen from either end, the
// other lies ahead, at most options.max_gap_px away, max_normal_distance_px off
// the line that the end continues on, in a direction at most max_angle_deg from
// it, and runs on in a direction at most as much off. The nearest ends first,
// where distance across counts twice; ties by the order of curves. A curve
// whose own ends meet becomes closed. Joined curves take the place and the
// direction of the first of them.
//
// Deviation: the paper's curves end where an edge has no neighbour; single
// missing edges then break them. options.max_gap_px = 0 returns the input.
std::vector<Curve> JoinCurves(std::vector<Curve> curves,
                              const std::vector<PosedView>& views,
                              const ConnectivityOptions& options);

}  // namespace curvix
