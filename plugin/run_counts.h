// SPDX-License-Identifier: BSD-3-Clause
// What the stages of the program count, for people and for the report.
#pragma once

#include <curvix/edges.h>
#include <curvix/fitting.h>
#include <curvix/reconstruct.h>

#include <string>
#include <vector>

namespace curvix {

using StageCounts = decltype(StageReport::counts);

// How many edges there are in all views; those left out, if any are.
StageCounts CountEdges(const std::vector<EdgeMap>& edge_maps);

// How many primitives of each kind there are.
StageCounts CountFits(const FittedCurves& fitted);

// "8 views, 123 edges"
std::string CountsText(const StageCounts& counts);

}  // namespace curvix
