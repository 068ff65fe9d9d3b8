// SPDX-License-Identifier: BSD-3-Clause
// The lengths and radii that a drawing states.
#pragma once

#include <curvix/fitting.h>
#include <optional>
#include <vector>

#include "drawing/sheet.h"

namespace curvix {

struct MeasuredDimension {
  SheetDimension drawn;  // without its shift
  double sigma = 0;      // of the value, > 0
};

// The length of a line from node to node or the radius of an arc, if the
// drawing shows it as it is: `flat` is FlatFit of `fit` and, by less than a
// standard deviation, as long. `scale_sigma` as of WorldAlignment. The value is
// written as well as it is known.
std::optional<MeasuredDimension> DimensionOf(const CurveFit& fit,
                                             const CurveFit& flat,
                                             double scale_sigma);

// The ten longest lines and the ten largest radii. Of parallel lines of one
// length, to three standard deviations, the outermost; of equal radii the
// first.
std::vector<SheetDimension> ChooseDimensions(
    const std::vector<MeasuredDimension>& measured);

}  // namespace curvix
