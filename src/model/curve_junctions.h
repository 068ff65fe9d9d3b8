// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (beyond it). Curves that meet share a node.
#pragma once

#include <curvix/curves.h>

namespace curvix {

// Makes junctions of the places, equal to the last bit, in which two or more
// ends of open curves lie: sets curves.junctions, in the order of their first
// ends, and the curves' indices into it. The two ends of one curve may be one.
void IndexJunctions(CurveSet& curves);

}  // namespace curvix
