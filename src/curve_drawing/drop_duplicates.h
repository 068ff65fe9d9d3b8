// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering), after Sec. 6. Curves drawn once.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <vector>

#include "model/posed_view.h"

namespace curvix {

// Drops duplicates of longer curves. Curves are taken by decreasing length in
// pixels (ties: smaller index), samples in order. A sample is dropped if one
// that stays, of an earlier curve or earlier on its own, is at most
// options.max_duplicate_distance_px across it, sample_spacing_px along it and
// max_angle_deg off in direction. Curves are split where samples are dropped;
// the parts are in the order of their curves.
//
// Deviation: the paper draws every track. Edges of the same place that no 2D
// edge links, since different views formed them, become parallel curves.
// options.max_duplicate_distance_px = 0 returns the input.
std::vector<Curve> DropDuplicates(std::vector<Curve> curves,
                                  const std::vector<PosedView>& views,
                                  const ConnectivityOptions& options);

}  // namespace curvix
