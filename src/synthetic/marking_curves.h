// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The exact edges of what is painted on a solid.
#pragma once

#include "synthetic/solid.h"
#include "synthetic/surfaces.h"
#include "synthetic/synthetic_scene.h"
#include "synthetic/true_curve.h"

#include <vector>

namespace curvix {

// The outlines of all patterns, as far as they lie on the surface of the solid;
// kind kMarking. Those shorter than a hundredth of its detail are left out, as
// is the texture.
std::vector<TrueCurve> MarkingCurves(const Solid& solid,
                                     const Surfaces& surfaces);

// Samples every `step` or so along the edges of cast shadows, without shadows
// none. `creases` are the edges of the solid, which cast them together with the
// round bodies. curve_id counts on from `first_id`; kind kMarking; likewise
// without the shortest.
std::vector<TrueSample> SampleShadowEdges(const Solid& solid,
                                          const Surfaces& surfaces,
                                          const std::vector<TrueCurve>& creases,
                                          double step,
                                          int first_id);

}  // namespace curvix
