// SPDX-License-Identifier: BSD-3-Clause
// Paper: Sec. 3, ref. [15]. The scale at which edges of an image are detected.
#pragma once

namespace curvix {

struct DetectionScale {
  double sigma_px = 1;     // of the Gaussian derivatives, > 0
  int samples_per_px = 2;  // along each axis, 1 or 2

  // Of edges along a contour.
  double spacing_px() const { return 1.0 / samples_per_px; }
};

}  // namespace curvix
