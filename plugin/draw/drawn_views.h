// SPDX-License-Identifier: BSD-3-Clause
// What elevations, plans and sections show, side by side on one sheet.
#pragma once

#include <curvix/scene.h>
#include <cstddef>
#include <string>
#include <vector>

#include "drawing/drawing_plane.h"
#include "drawing/sheet.h"
#include "plugin/align/curves_file.h"
#include "plugin/draw/choose_dimensions.h"
#include "plugin/draw/draw_window.h"

namespace curvix {

// One elevation, plan or section.
struct DrawnView {
  DrawingPlane plane;
  DrawWindow window = {};
  std::vector<SheetCurve> curves = {};
  std::vector<MeasuredDimension> measured = {};  // of whole primitives
  int num_unknown = 0;      // primitives that may be hidden or not
  std::size_t num_far = 0;  // left out, far from the others
};

struct DrawnContent {
  const CurvesFile& curves;
  const Scene& scene;  // in the frame of the curves
  std::string hidden;  // "dashed", "omitted" or "solid"
  bool has_dimensions = false;
  bool leaves_out_far = false;  // what MainBoundsOf does not hold
};

// Fills views that have a plane and a window. Others are put beside the first
// one by moving their origins, as in third-angle projection: above or below it
// if they share its horizontal, else to the side from which they are seen.
void FillViews(const DrawnContent& content, std::vector<DrawnView>* views);

}  // namespace curvix
