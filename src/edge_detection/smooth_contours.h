// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Edges without the scatter along their contours.
#pragma once

#include <curvix/edges.h>

#include <vector>

namespace curvix {

// Texture and noise scatter the edges of a contour by some tenths of a pixel
// and some degrees. A parabola is fitted to the contour as far on one side of
// an edge as on the other, at most 16 px, or less where it leaves the parabola
// by more than 0.25 px (root mean square) or bends by more than a radian. The
// edge moves onto the parabola, across its tangent, and turns to it. It stays
// if there are less than 2 px on either side, or fewer than five edges in all.
// Edges and `neighbors` correspond.
void SmoothContours(const std::vector<EdgeNeighbors>& neighbors,
                    std::vector<Edge2d>* edges);

}  // namespace curvix
