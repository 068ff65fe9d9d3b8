// SPDX-License-Identifier: BSD-3-Clause
// The part of space that a drawing shows.
#pragma once

#include <curvix/fitting.h>
#include <curvix/status.h>
#include <string>
#include <vector>

#include "base/infinity.h"
#include "drawing/drawing_plane.h"

namespace curvix {

struct DrawRange {
  double from = -kInfinity;
  double to = kInfinity;
};

// Coordinates of the drawing, and depths.
struct DrawWindow {
  DrawRange depth;
  DrawRange across;
  DrawRange upwards;
};

// Of --slice, "FROM,TO", and --crop, "LEFT,BOTTOM,RIGHT,TOP". Empty, or "all"
// as crop: without limits. kInvalidArgument: they are neither.
Result<DrawWindow> ParseWindow(const std::string& slice,
                               const std::string& crop);

// The parts of `fit` that are in the window, in their order; `fit` itself if
// that is all of it.
std::vector<CurveFit> PartsInWindow(const CurveFit& fit,
                                    const DrawingPlane& plane,
                                    const DrawWindow& window);

}  // namespace curvix
