// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering), after Sec. 6. Curves drawn once.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Cuts out what a longer curve draws already. Curves are taken by decreasing
// length in pixels (ties: smaller index), samples in order; one goes if a
// sample that stays, of an earlier curve or further back on its own, is at most
// options.max_duplicate_distance_px across it, sample_spacing_px along it and
// max_angle_deg off in direction. Curves fall apart where samples go; the
// pieces come in the order of the curves that they come from.
//
// Deviation: the paper draws every track. Edges of the same place that no 2D
// edge links, since different views formed them, come out as curves side by
// side. options.max_duplicate_distance_px = 0 returns the input.
std::vector<Curve> DropDuplicates(std::vector<Curve> curves,
                                  const std::vector<PosedView>& views,
                                  const ConnectivityOptions& options);

}  // namespace curvix
