// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Edges without the scatter along their contours.
#pragma once

#include <curvix/edges.h>

#include <vector>

namespace curvix {

// Texture and noise scatter the edges of a contour by some tenths of a pixel
// and some degrees. A parabola is fitted to the contour as far on one side of
// an edge as on the other, at most 16 px. The edge moves onto it, across its
// tangent, and turns to it. If the contour leaves the parabola by more than
// 0.25 px (root mean square) or bends by more than a radian on either side,
// half as much is fitted, and so on. The edge stays if this comes below 2 px or
// five edges. Edges and `neighbors` correspond; links stay as they are.
void SmoothContours(const std::vector<EdgeNeighbors>& neighbors,
                    std::vector<Edge2d>* edges);

}  // namespace curvix
