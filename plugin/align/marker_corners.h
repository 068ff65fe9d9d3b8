// SPDX-License-Identifier: BSD-3-Clause
// Corners of markers from the edges of their sides.
#pragma once

#include <curvix/edges.h>
#include <curvix/scene.h>
#include <optional>
#include <vector>

#include "plugin/align/marker_detector.h"

namespace curvix {

// The corners in which lines through the edges of the four sides meet.
// Detectors that look at a corner itself find it a tenth of a pixel inside,
// where blur has rounded it off; edges within a tenth of a side from a corner
// do not count. `edges` are those of the view in its ideal pinhole. nullopt: a
// side has too few edges.
std::optional<SeenMarker> CornersFromSides(const SeenMarker& marker,
                                           const Camera& camera,
                                           const std::vector<Edge2d>& edges);

}  // namespace curvix
