// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The solids that can be asked for.
#pragma once

#include "synthetic/solid.h"

#include <curvix/synthetic.h>

namespace curvix {

// `solid` centred on the origin, z up, longest side `scale` world units; a
// facade has that height, and the length that `num_views` photographs need.
//
// For CreaseCurves to know every edge, round faces meet planar ones only, and
// planes meet frustums at right angles to the axis.
Solid MakeSolid(SyntheticSolid solid, double scale, int num_views = 3);

}  // namespace curvix
