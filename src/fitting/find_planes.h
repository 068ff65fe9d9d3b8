// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Which lines and arcs lie in one plane.
#pragma once

#include <curvix/fitting.h>

#include <vector>

#include "fitting/line_or_arc.h"

namespace curvix {

// Adds the groups of coplanar fits, as FindStructure describes them. Candidates
// are the planes of arcs and of pairs of lines that meet in a node, the largest
// first; a pair that is in a plane already is none. A group stays if the number
// of candidates times the chance that so many points lie in one of them by
// accident is below a hundredth: of each point but three, the share of `extent`
// that its uncertainty covers, times the points of the group, one of which it
// could be attached to.
void AddPlanes(const std::vector<LineOrArc>& features,
               const FittedCurves& fitted,
               double extent,
               std::vector<FitGroup>& groups);

}  // namespace curvix
