// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Edges side by side, where blur has moved them.
#pragma once

#include <curvix/edges.h>

#include <vector>

namespace curvix {

// Moves parallel edges to where they would be if blur had not mixed them. The
// detector sees steps blurred by a Gaussian, of which standard deviation w the
// median sharpness tells. Two steps within some 4 w add up: of a thin line,
// dark to bright and back, the two peaks of the gradient lie too far apart, at
// least 2 w; of a staircase, too close together. From places and strengths of
// the two peaks both steps follow. Each edge is seen with the nearest parallel
// edge (37 degrees) on either side, and moves at most 0.6 w for each, since
// peaks hardly tell steps nearer than w apart.
void SeparateEdges(std::vector<Edge2d>* edges);

}  // namespace curvix
