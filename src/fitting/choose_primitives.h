// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Which lines, arcs, ellipses and splines a curve is
// made of.
#pragma once

#include <vector>

#include "fitting/primitive.h"

namespace curvix {

// The primitives of an open or closed curve of two or more samples, in order,
// as FitCurves describes them, each fitted alone. Neighbours share a sample.
std::vector<Primitive> ChoosePrimitives(const FitSamples& curve, bool closed);

}  // namespace curvix
