// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). The exact sharp edges of a solid.
#pragma once

#include "synthetic/solid.h"
#include "synthetic/true_curve.h"

#include <vector>

namespace curvix {

// Every edge at which two faces of the solid meet at an angle of more than
// about 25 degrees, each once, whole: an edge that others touch stays one
// curve. Faces that continue each other smoothly make no edge. Candidates are
// plane with plane, plane with frustum at right angles to its axis, and plane
// with sphere; other pairs are not looked at. Edges shorter than a hundredth of
// the solid's radius are left out.
//
// Sheets have edges at their rims alone: creases where they stand on a face or
// touch another sheet, boundaries elsewhere.
std::vector<TrueCurve> CreaseCurves(const Solid& solid);

}  // namespace curvix
