// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Which edges of a view ask for hypotheses.
#pragma once

#include <curvix/edges.h>
#include <cstdint>
#include <vector>

#include "edge_sketch/sketch_input.h"

namespace curvix {

// For each edge whether its contour may become a curve: where the strengths of
// the contour's edges add up to what `min_contour_edges` edges of median
// strength have. A contour is what mutual links join.
std::vector<bool> AreOnStrongContours(const EdgeMap& map,
                                      int min_contour_edges);

// One in input.h1_step of the edges of a view, those that are not used yet; of
// seeds only those on strong contours. Ascending.
std::vector<std::int32_t> QueryEdges(const SketchInput& input,
                                     int view_idx,
                                     const UsedEdges& used);

// Links along a contour from one edge that asks to the next: every other one
// asks, of crowded images one in four, and one in eight for seeds.
int LinksBetweenQueries(const SketchInput& input);

}  // namespace curvix
