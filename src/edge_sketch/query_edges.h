// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). The edges of a view for which hypotheses are made.
#pragma once

#include <curvix/edges.h>
#include <cstdint>
#include <vector>

#include "edge_sketch/sketch_input.h"

namespace curvix {

// For each edge whether its contour is strong enough for a curve: the strengths
// of its edges sum to at least `min_contour_edges` times the median strength.
// Mutual links join the edges of a contour.
std::vector<bool> AreOnStrongContours(const EdgeMap& map,
                                      int min_contour_edges);

// One in input.h1_step of the unused edges of a view; for seeds only those on
// strong contours. Ascending.
std::vector<std::int32_t> QueryEdges(const SketchInput& input,
                                     int view_idx,
                                     const UsedEdges& used);

// Number of links along a contour from one query edge to the next: two, four in
// crowded images, eight for seeds.
int LinksBetweenQueries(const SketchInput& input);

}  // namespace curvix
