// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Corrects the shift of parallel edges by blur.
#pragma once

#include <curvix/edges.h>

#include <vector>

namespace curvix {

// The detector sees steps blurred by a Gaussian. Its standard deviation w
// follows from the median sharpness. Two steps within some 4 w add up: of a
// thin line, dark to bright and back, the two peaks of the gradient lie too far
// apart, at least 2 w; of a staircase, too close together. Positions and
// strengths of the two peaks determine both steps. Each edge is corrected for
// the nearest parallel edge (37 degrees) on either side, by at most 0.6 w each,
// since peaks hardly resolve steps nearer than w. `spacing_px`: the mean
// distance between edges along a contour (EdgeMap).
void SeparateEdges(double spacing_px, std::vector<Edge2d>* edges);

}  // namespace curvix
