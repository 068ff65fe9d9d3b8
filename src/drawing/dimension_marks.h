// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Lengths and radii written into a drawing.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "drawing/sheet.h"

namespace curvix {

// What is drawn of a dimension: a line with ticks and two lines to what it
// measures, or a line to an arc.
struct DimensionMarks {
  std::vector<SheetLine> lines;
  SheetText text;    // centred about its start
  double angle = 0;  // of the text, radians
};

DimensionMarks MarksOf(const SheetDimension& dimension, const Sheet& sheet);

// Those of `dimensions` that are large enough on paper go onto the sheet, in
// their order, each on the side of its line that is away from the middle of
// `view`, and further away where another one is in its place. None goes where
// the other views on the sheet are, all in drawing units.
void PlaceDimensions(std::vector<SheetDimension> dimensions,
                     const Eigen::AlignedBox2d& view,
                     const std::vector<Eigen::AlignedBox2d>& other_views,
                     Sheet& sheet);

}  // namespace curvix
