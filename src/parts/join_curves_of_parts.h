// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves across the borders of parts.
#pragma once

#include <curvix/curves.h>
#include <curvix/options.h>
#include <curvix/parts.h>

#include <vector>

#include "model/posed_view.h"

namespace curvix {

// JoinParts of parts.h, for posed views; junctions are not indexed.
//
// Of the samples that several parts have of one place, one stays
// (twin_samples.h), so that curves fall into stretches. Beyond its end, a
// stretch goes on as its part has drawn it: the first sample there that has a
// twin that stays leads to the stretch to which it is tied; the nearest first.
// Where the next stretch would step back, its first samples go.
std::vector<Curve> JoinCurvesOfParts(
    const ScenePartition& partition,
    std::vector<std::vector<Curve>> curves_of_parts,
    const std::vector<PosedView>& views,
    const Options& options);

}  // namespace curvix
