// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Scenes like machine parts, houses and tables.
#pragma once

#include "synthetic/solid.h"
#include "synthetic/synthetic_scene.h"

namespace curvix {

// `solid` centred on the origin, z up, longest side `scale` world units; a
// facade has that height, and the length that `num_views` images need.
// `pattern` is painted on every added body; kMixed: on each what suits it.
//
// For CreaseCurves to know every edge, round faces meet planar ones only, and
// planes meet frustums at right angles to the axis.
Solid MakeSolid(SyntheticSolid solid,
                double scale,
                int num_views = 3,
                SurfacePattern pattern = SurfacePattern::kNone);

}  // namespace curvix
