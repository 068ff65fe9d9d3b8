// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 4, Fig. 5(b). Moves an H2 edge onto the epipolar line.
#pragma once

#include <curvix/options.h>
#include <optional>

#include "geometry/edge_geometry.h"
#include "geometry/epipolar.h"

namespace curvix {

// `edge` moved onto `line`, by the first of these that is possible:
//  1. a slide along its tangent t, p' = p - t (n.p + c) / (n.t), of at most
//     max_tangent_shift_px;
//  2. the same after a turn towards the normal of the line by max_turn_deg,
//     which shortens the slide; the turned tangent is kept;
//  3. for an edge within location_tolerance_px of the line, a shift along the
//     line's normal; the tangent is kept.
// nullopt if none is possible. The signs of the tangent and of the line's
// normal make no difference.
std::optional<ImageEdge> SlideToLine(const ImageEdge& edge,
                                     const Line2& line,
                                     double location_tolerance_px,
                                     const ConsolidationOptions& options);

}  // namespace curvix
