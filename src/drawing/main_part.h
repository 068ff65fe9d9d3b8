// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). What a drawing is of, without what lies far away.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "drawing/sheet.h"

namespace curvix {

// The bounding box, in drawing units, of the curves without those that a gap
// separates from the others: across or upwards as wide as three tenths of the
// longer side of what these take. All curves count if those have more than a
// tenth of the length.
Eigen::AlignedBox2d MainBoundsOf(const std::vector<SheetCurve>& curves);

}  // namespace curvix
